#pragma once
// Numbers, ranges and lists as users write them: "3", "1:0.5:20", "1,2,5".
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

inline constexpr const char* how_to_write =
    "write a:step:b, such as 1:0.5:20, or a list, such as 1,2,5";

constexpr std::size_t most_points = 1'000'000;

/// The whole text as a finite or infinite number, blanks around it aside.
std::optional<double> parse_number(std::string_view text);

/// Whether a text is written as a range or list rather than as one value.
bool is_range_or_list(std::string_view text);

/// Values of "a", "a:step:b" (b included within rounding) or "a,b,c". A range gives the same
/// numbers as its values typed out: 0.1:0.1:0.3 ends at 0.3 exactly. `problem` opens the error
/// line.
std::vector<double> parse_values(std::string_view text, const std::string& problem);

/// A list as long as `size`: one number holds throughout. `key` names the list in the error line
/// and `whole` what it is a list of: "the way has 3 way-points".
std::vector<double> stretched(std::vector<double> list, std::size_t size, const std::string& key,
                              const std::string& whole);

/// Throws, as nobody means so many values.
[[noreturn]] void refuse_size(const std::string& problem);

}  // namespace sim
