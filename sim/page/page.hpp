#pragma once
// A report as one HTML file that needs nothing else: still pictures and tables, which a script
// makes live where the browser runs it and uPlot was at hand when the program was built.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/page/trial_view.hpp"
#include "sim/picture/chart.hpp"

namespace sim {

struct PageTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // as long as the head each
  bool is_answer = false;                      // is open however long it is
};

struct PagePicture {
  std::string name;     // of its file, without the ending
  std::string caption;  // also for who cannot see it
  std::string svg;
  std::optional<Chart> live = {};  // the same, for the script to draw
};

/// "Bit errors" as the name of a file, without its ending: "bit-errors".
std::string picture_name(const std::string& title);

PagePicture picture_of(Chart chart);

/// A trial with every tap, and the same as a still picture.
struct PageTrial {
  TrialView view;
  PagePicture still;
};

struct PageSection {
  std::string heading;
  std::string text = {};          // a paragraph a line
  std::string preformatted = {};  // a scenario, a command
  std::optional<PagePicture> picture = {};
  std::optional<PageTrial> trial = {};
  std::optional<PageTable> table = {};
};

/// All texts are UTF-8 of any content: they are shown, never obeyed.
struct Page {
  std::string title;
  std::string verdict;  // a paragraph a line
  std::vector<PageSection> sections;
};

std::string page_as_html(const Page& page);

/// Whether a file is such a page.
bool is_page(const std::filesystem::path& path);

}  // namespace sim
