#pragma once
// Share bars of a dataset: what the counts of each point are made of.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/picture/share_bars.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// A kind of what is counted: the variable, and its words.
struct CountedKind {
  std::string name, words;
};

/// A row for each point that has runs, of the sums of all that the variables have of it; where
/// there are too many points, for each value of the longest axis. At most nine kinds.
ShareBars point_shares(const Dataset& data, const std::string& title, const std::string& of,
                       const std::vector<CountedKind>& kinds);

/// The same of counts that are not variables: one a kind, which must be as many.
ShareBars point_shares(const Dataset& data, const std::string& title, const std::string& of,
                       std::vector<std::string> kinds,
                       const std::function<std::vector<std::uint64_t>(std::size_t point)>& counts);

/// Of a single point, a row for each element of the variables' one dimension.
ShareBars element_shares(const Dataset& data, const std::string& title, const std::string& of,
                         const std::vector<CountedKind>& kinds);

}  // namespace sim
