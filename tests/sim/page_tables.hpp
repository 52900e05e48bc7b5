#pragma once
// Tables of a report's page, read back.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace sim {

/// The texts between `open` and `close`, one after the other.
inline std::vector<std::string> texts_between(const std::string& html, const std::string& open,
                                              const std::string& close) {
  std::vector<std::string> texts;
  for (auto at = html.find(open); at != std::string::npos; at = html.find(open, at)) {
    at += open.size();
    texts.push_back(html.substr(at, html.find(close, at) - at));
  }
  return texts;
}

/// The rows of the table under a heading, cells by the names of their columns.
inline std::vector<std::map<std::string, std::string>> table_under(const std::string& page,
                                                                   const std::string& heading) {
  std::vector<std::map<std::string, std::string>> rows;
  const auto sections = texts_between(page, "<h2>" + heading + "</h2>", "</section>");
  if (sections.empty()) ADD_FAILURE() << "no section " << heading;
  for (const std::string& section : sections) {
    const std::vector<std::string> head = texts_between(section, "<th scope=\"col\">", "</th>");
    for (const std::string& row : texts_between(section, "<tr><td>", "</tr>")) {
      const std::vector<std::string> cells = texts_between("<td>" + row, "<td>", "</td>");
      EXPECT_EQ(cells.size(), head.size());
      rows.emplace_back();
      for (std::size_t i = 0; i < std::min(cells.size(), head.size()); ++i)
        EXPECT_TRUE(rows.back().emplace(head[i], cells[i]).second) << "twice: " << head[i];
    }
  }
  return rows;
}

}  // namespace sim
