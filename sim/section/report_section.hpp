#pragma once
// What one result brings to a report, of whatever experiment it is.
#include <string>
#include <vector>

#include "sim/picture/chart.hpp"
#include "sim/scenario/settings.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

/// How far a link reaches.
struct LinkRange {
  std::string along;    // the key
  std::string link;     // "receiver.module = TSOP4856"; empty of the only one
  std::string words;    // "7.88 [7.60, 8.20] m"
  double merit = 0;     // of its ranking
  bool is_told = true;  // counted far enough to have a place there
};

struct ReportSection {
  std::string name;                      // of its file
  std::string title;                     // of its scenario; may be empty
  std::string summary;                   // a paragraph a line
  PageSection scenario{};                // its text, and the command that repeats it
  std::vector<LinkRange> link_ranges{};  // of links
  std::vector<PageSection> first{};
  /// Those of several results that have one title and one lower axis are drawn into one picture.
  std::vector<Chart> charts{};
  std::vector<PageSection> sections{};  // behind the charts
  std::vector<Setting> settings{};      // of its scenario
};

}  // namespace sim
