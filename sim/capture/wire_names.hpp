#pragma once
// WireNames: what the wires of a design are called. A name stands in a scope, one code may have
// several, and one name may be that of several codes. Each wire is listed by its name alone where
// no other code has it, else by its place, such as top.dut.rx. A name that several have is listed
// too, last, and means the first of them; so is the place that was asked for, or the end of a
// place, such as dut.rx, that only one code has.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sim {

/// "rx" of "rx[0:0]": a vector of one bit, as simulators declare a wire. Other names as they are.
std::string without_range(const std::string& name);

class WireNames {
 public:
  explicit WireNames(std::string asked) : asked_(std::move(asked)) {}

  void enter(std::string_view scope);
  void leave();
  void add(std::string name, std::size_t code);
  /// Behind the last: makes the list.
  void finish();

  const std::vector<std::string>& list() const { return list_; }
  /// The places of a code's names in the list, one after the other, in no order.
  std::optional<std::size_t> first_of(std::size_t code) const { return to_place(first_[code]); }
  std::optional<std::size_t> behind(std::size_t place) const { return to_place(next_[place]); }

  /// Of memory, about.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Variable {
    std::string name;
    std::size_t scope, code;
  };
  struct Listed {
    std::size_t variable;
    bool by_place;
  };

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static std::optional<std::size_t> to_place(std::size_t place) {
    return place == none ? std::nullopt : std::optional(place);
  }
  void note_if_asked(const Variable& variable);
  std::string path_of(const Variable& variable) const;
  /// What `asked_` has before the variable's name; nothing where that is not at its end.
  std::optional<std::string> scope_asked_for(const Variable& variable) const;
  bool is_before(std::size_t a, std::size_t b) const;
  std::vector<std::size_t> by_name_and_code() const;
  std::vector<Listed> chosen() const;
  void list_as(std::string name, std::size_t code);

  std::string asked_;
  std::optional<std::size_t> asked_code_;   // of the variable whose place was asked for
  std::optional<std::size_t> ending_code_;  // of the first whose place ends so
  bool ending_is_shared_ = false;           // with another code
  std::vector<std::string> scopes_ = {""};  // their places, each with a dot behind
  std::vector<std::size_t> open_ = {0};     // the scopes that are open
  std::vector<Variable> variables_;         // as declared
  std::vector<std::string> list_;
  std::vector<std::size_t> first_, next_;  // place of a code's first name; of the next of its names
  std::size_t bytes_ = 0;
};

}  // namespace sim
