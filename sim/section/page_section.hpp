#pragma once
// A section of a report: a heading, and below it text, a picture, a table.
#include <optional>
#include <string>
#include <vector>

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
  std::string view;  // as JSON, for the script
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

}  // namespace sim
