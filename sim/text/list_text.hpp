#pragma once
// Lists as a user types them: "1, 2, 5".
#include <string_view>
#include <vector>

namespace sim {

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// What stands between the separators, blanks included; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace sim
