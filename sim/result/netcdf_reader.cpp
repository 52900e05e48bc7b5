#include "sim/result/netcdf_reader.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/reading_process.hpp"
#include "sim/text/input_file.hpp"

namespace sim {
namespace {

template <class T>
std::vector<T> numbers_in(const std::string& answer) {
  std::vector<T> numbers(answer.size() / sizeof(T));
  if (!numbers.empty()) std::memcpy(numbers.data(), answer.data(), numbers.size() * sizeof(T));
  return numbers;
}

std::vector<std::string> texts_in(const std::string& answer) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; at < answer.size(); at += texts.back().size() + 1)
    texts.emplace_back(answer.c_str() + at);
  return texts;
}

const char* why_not_open(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path)
             ? "not an HDF5 file that can be read"
             : "a pipe or a device, and HDF5 can be read from files alone";
}

}  // namespace

std::string filetype_of(const std::filesystem::path& path) {
  ReadingProcess process(path);
  return process.ask({.what = Asked::attribute_text, .name = "filetype"}).value_or("");
}

struct NetcdfReader::State {
  std::string path;
  ReadingProcess process;

  [[noreturn]] void refuse(const Question& question) const {
    const std::string what = question.what == Asked::variables ? "variables" : question.name;
    throw bad_input(path, "no " + what + " in it: damaged, or of another program",
                    "choose another file");
  }

  std::string ask(const Question& question) {
    std::optional<std::string> answer = process.ask(question);
    if (!answer) refuse(question);
    return *std::move(answer);
  }
  template <class T>
  T number(const Question& question) {
    const std::vector<T> numbers = numbers_in<T>(ask(question));
    if (numbers.size() != 1) refuse(question);
    return numbers.front();
  }
  bool is_so(const Question& question) { return number<std::uint8_t>(question) != 0; }

  template <class T>
  void fill(std::span<T> to, const Question& question) {
    const std::vector<T> numbers = numbers_in<T>(ask(question));
    if (numbers.size() != to.size()) refuse(question);
    std::ranges::copy(numbers, to.begin());
  }
};

bool is_result_of_run(const std::filesystem::path& path) {
  const std::string type = filetype_of(path);
  return type == link_result_type || type == experiment_result_type;
}

NetcdfReader::NetcdfReader(const std::filesystem::path& path)
    : state_((refuse_no_file(path, "result"), new State{path.string(), ReadingProcess(path)})) {
  if (!state_->process.ask({.what = Asked::opens}))
    throw bad_input(path.string(), why_not_open(path), "choose another file");
}
NetcdfReader::~NetcdfReader() = default;

bool NetcdfReader::has(const std::string& name) const {
  return state_->is_so({Asked::has_variable, name});
}

std::vector<std::int64_t> NetcdfReader::integers(const std::string& variable) const {
  return numbers_in<std::int64_t>(state_->ask({Asked::integers, variable}));
}

std::vector<double> NetcdfReader::reals(const std::string& variable) const {
  return numbers_in<double>(state_->ask({Asked::reals, variable}));
}

std::vector<std::string> NetcdfReader::texts(const std::string& variable) const {
  return texts_in(state_->ask({Asked::texts, variable}));
}

std::vector<std::string> NetcdfReader::variables() const {
  return texts_in(state_->ask({Asked::variables}));
}

VariableDescription NetcdfReader::description(const std::string& variable) const {
  constexpr std::size_t words = 5;  // before the dimensions
  const Question question{Asked::description, variable};
  const std::vector<std::string> texts = texts_in(state_->ask(question));
  if (texts.size() < words) state_->refuse(question);
  return {.facts = {variable, texts[2], texts[3]},
          .flag_meanings = texts[4],
          .is_dimension = !texts[0].empty(),
          .is_text = texts[1] == "text",
          .is_integer = texts[1] == "integer",
          .dimensions = {texts.begin() + words, texts.end()}};
}

std::size_t NetcdfReader::size(const std::string& variable) const {
  return state_->number<std::uint64_t>({Asked::size, variable});
}

void NetcdfReader::read(const std::string& variable, std::size_t first,
                        std::span<std::uint8_t> to) const {
  state_->fill(to, {Asked::bytes, variable, first, to.size()});
}

void NetcdfReader::read(const std::string& variable, std::size_t first, std::span<float> to) const {
  state_->fill(to, {Asked::floats, variable, first, to.size()});
}

std::string NetcdfReader::text(const char* name) const {
  return state_->ask({Asked::attribute_text, name});
}

std::string NetcdfReader::text(const char* name, const char* otherwise) const {
  const bool there = state_->is_so({Asked::has_attribute, name});
  return there ? text(name) : otherwise;
}

std::uint64_t NetcdfReader::whole_number(const char* name) const {
  return state_->number<std::uint64_t>({Asked::attribute_whole, name});
}

double NetcdfReader::real_number(const char* name) const {
  return state_->number<double>({Asked::attribute_real, name});
}

}  // namespace sim
