#pragma once
// What one result brings to a report, of whatever experiment it is, and how the parts of several
// become one page.
#include <string>
#include <vector>

#include "sim/page/page.hpp"
#include "sim/page/reach.hpp"
#include "sim/picture/chart.hpp"
#include "sim/scenario/settings.hpp"

namespace sim {

struct ReportPart {
  std::string name;              // of its file
  std::string title;             // of its scenario; may be empty
  std::string verdict;           // a paragraph a line
  PageSection scenario{};        // its text, and the command that repeats it
  std::vector<Reach> reaches{};  // of links
  std::vector<PageSection> first{};
  /// Those of several results that have one title and one lower axis are drawn into one picture.
  std::vector<Chart> charts{};
  std::vector<PageSection> sections{};  // behind the charts
  std::vector<Setting> settings{};      // of its scenario
};

/// At least one part. First come scenarios. Where there are several, headings and curves say whose
/// they are, and before them stands how far links reach, and in what the scenarios differ.
Page page_of(std::vector<ReportPart> parts);

}  // namespace sim
