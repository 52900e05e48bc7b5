#pragma once
// A report as one HTML file that needs nothing else: still pictures and tables, which a script
// makes live where the browser runs it and uPlot was at hand when the program was built.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/section/page_section.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

/// All texts are UTF-8 of any content: they are shown, never obeyed.
struct Page {
  std::string title;
  std::string summary;  // a paragraph a line
  std::vector<PageSection> sections;
};

/// At least one section of a result. Scenarios come last. Where there are several results, headings
/// and curves say whose they are, and before them stands how far links reach, and in what the
/// scenarios differ.
Page page_of(std::vector<ReportSection> results);

/// A first section that has a picture and the table of an answer stands right below the summary's
/// first line, and its table opens by a click.
std::string page_as_html(const Page& page);

/// Whether a file is such a page.
bool is_page(const std::filesystem::path& path);

}  // namespace sim
