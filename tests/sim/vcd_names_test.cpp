// By which names the wires of a VCD are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "vcd_reading.hpp"

namespace sim {
namespace {

using Random = std::mt19937_64;

/// The names of wires, and of each the time of its edge.
std::string names_and_edges(const std::string& text, const std::string& asked = "") {
  std::string line;
  for (const NamedTrace& wire : wires_in(text, with_wire(asked)))
    line += wire.name + "@" + std::to_string(std::lround(edges_to_ns(wire.trace).at(0))) + " ";
  return line;
}

std::string scoped(const std::string& variables) {
  return "$timescale 1 us $end\n$scope module top $end\n" + variables +
         "$upscope $end $enddefinitions $end\n#0 1! 1\" 1# #1 0! #2 0\" #3 0#";
}

TEST(VcdNames, AWireHasEachOfItsNames) {
  const std::string text = scoped(
      "$var wire 1 ! uart_line $end $scope module dut $end $var wire 1 ! rx $end "
      "$var wire 1 \" tx $end $upscope $end $var wire 1 # tx_n $end\n");
  EXPECT_EQ(names_and_edges(text), "uart_line@1 rx@1 tx@2 tx_n@3 ");
  EXPECT_EQ(names_and_edges(text, "rx"), names_and_edges(text));
  EXPECT_EQ(names_and_edges(text, "top.dut.rx"), names_and_edges(text) + "top.dut.rx@1 ");
  EXPECT_EQ(names_and_edges(text, "top.tx_n"), names_and_edges(text) + "top.tx_n@3 ");
  EXPECT_EQ(names_and_edges(text, "dut.rx"), names_and_edges(text) + "dut.rx@1 ");
  EXPECT_EQ(names_and_edges(text, "dut.tx_n"), names_and_edges(text));  // no such wire
  EXPECT_EQ(names_and_edges(text, "ut.rx"), names_and_edges(text));
}

TEST(VcdNames, WiresOfOneNameAreToldApartByTheirPlaces) {
  const std::string text = scoped(
      "$var wire 1 ! rx $end $scope module dut $end $var wire 1 \" rx $end "
      "$scope module pad $end $var wire 1 \" rx $end $upscope $end "
      "$upscope $end $var wire 1 # tx $end\n");
  EXPECT_EQ(names_and_edges(text), "top.rx@1 top.dut.rx@2 tx@3 rx@1 ");
  EXPECT_EQ(names_and_edges(text, "top.dut.pad.rx"), names_and_edges(text) + "top.dut.pad.rx@2 ");
}

TEST(VcdNames, APlaceIsThatOfAVectorOfOneBitToo) {
  const std::string text = scoped(
      "$scope module dut $end $var wire 1 ! rx [0:0] $end $upscope $end $var wire 1 # tx[1:0] "
      "$end $var wire 1 \" en $end\n");
  for (const std::string place : {"top.dut.rx", "dut.rx", "dut.rx[0:0]"})
    EXPECT_EQ(names_and_edges(text, place), "rx[0:0]@1 tx[1:0]@3 en@2 " + place + "@1 ");
  EXPECT_EQ(names_and_edges(text, "top.tx"), "rx[0:0]@1 tx[1:0]@3 en@2 ");
}

TEST(VcdNames, WiresOfOneNameAndPlaceAreListedAsDeclared) {
  EXPECT_EQ(names_and_edges("$timescale 1 us $end $var wire 1 ! rx $end $var wire 1 \" rx $end "
                            "$upscope $end $enddefinitions $end #0 1! 1\" #1 0! #2 0\""),
            "rx@1 rx@2 ");
}

// Each name of each wire, in random designs: its edge is that of its code.
TEST(VcdNames, NamesLeadToTheirCodesInAnyDesign) {
  Random random(24);
  for (int round = 0; round < 300; ++round) {
    std::string text = "$timescale 1 us $end\n", place;
    std::map<std::string, std::size_t> code_of;   // by the place
    std::map<std::string, std::size_t> first_of;  // by the name alone
    for (auto n = 1 + random() % 20; n > 0; --n) {
      const std::string name(1, static_cast<char>('a' + random() % 4));
      const auto kind = random() % 4;
      if (kind == 0) {
        text += "$scope module s" + name + " $end\n";
        place += "s" + name + ".";
      } else if (kind == 1 && !place.empty()) {
        text += "$upscope $end\n";
        place.resize(place.size() - 3);
      } else if (const auto code = random() % 6; code_of.try_emplace(place + name, code).second) {
        text +=
            "$var wire 1 " + std::string(1, static_cast<char>('!' + code)) + " " + name + " $end\n";
        first_of.try_emplace(name, code);
      }
    }
    text += "$enddefinitions $end\n#0\n";
    for (std::size_t code = 0; code < 6; ++code)
      if (std::ranges::any_of(code_of, [&](const auto& one) { return one.second == code; }))
        text += "#" + std::to_string(code + 1) + " 0" + static_cast<char>('!' + code) + "\n";
    const auto edge_of = [&](const std::string& wire) {
      const auto wires = wires_in(text, with_wire(wire));
      const auto found = std::ranges::find(wires, wire, &NamedTrace::name);
      return found == wires.end() ? -1.0 : edges_to_ns(found->trace).at(0);
    };
    for (const auto& [place_of, code] : code_of) first_of[place_of] = code;
    for (const auto& [wire, code] : first_of)
      EXPECT_EQ(edge_of(wire), static_cast<double>(code) + 1) << wire << " of\n" << text;
    std::map<std::string, std::set<std::size_t>> codes_of;  // by the end of the place
    for (const auto& [place_of, code] : code_of)
      for (auto dot = place_of.find('.'); dot != std::string::npos;
           dot = place_of.find('.', dot + 1))
        codes_of[place_of.substr(dot + 1)].insert(code);
    for (const auto& [wire, codes] : codes_of) {
      if (first_of.contains(wire)) continue;
      EXPECT_EQ(edge_of(wire), codes.size() == 1 ? static_cast<double>(*codes.begin()) + 1 : -1)
          << wire << " of\n"
          << text;
    }
  }
}

}  // namespace
}  // namespace sim
