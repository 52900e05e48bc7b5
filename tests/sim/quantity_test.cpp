#include "sim/text/quantity.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/failure.hpp"

namespace {

using sim::has_unit;
using sim::in_unit;

std::string why_not(const std::string& text, const std::string& unit, const std::string& problem) {
  try {
    return "taken as " + in_unit(text, unit, problem);
  } catch (const sim::Failure& failure) {
    return failure.what();
  }
}

TEST(Quantity, IsConvertedIntoTheUnitOfItsKey) {
  EXPECT_EQ(in_unit("3m", "m", ""), "3");
  EXPECT_EQ(in_unit(" 7 cm ", "m", ""), "0.07");
  EXPECT_EQ(in_unit("1cm", "mm", ""), "10");
  EXPECT_EQ(in_unit("0.1A", "mA", ""), "100");
  EXPECT_EQ(in_unit("1.2MHz", "Hz", ""), "1200000");
  EXPECT_EQ(in_unit("38kHz", "Hz", ""), "38000");
  EXPECT_EQ(in_unit("9.6kBd", "Bd", ""), "9600");
  EXPECT_EQ(in_unit("2.5e-3s", "ms", ""), "2.5");
  EXPECT_EQ(in_unit("158µs", "us", ""), "158");
  EXPECT_EQ(in_unit("2min", "s", ""), "120");
  EXPECT_EQ(in_unit("500lux", "lx", ""), "500");
  EXPECT_EQ(in_unit("30mW/m2", "W/m2", ""), "0.03");
  EXPECT_EQ(in_unit("-90deg", "degree", ""), "-90");
  EXPECT_EQ(in_unit("+20 °C", "degree_C", ""), "20");
  EXPECT_EQ(in_unit("5%", "1", ""), "0.05");
  EXPECT_EQ(in_unit("0.1%", "1e-6", ""), "1000");
  EXPECT_EQ(in_unit("10ppm", "1e-6", ""), "10");
}

TEST(Quantity, MayBeARangeOrAList) {
  EXPECT_EQ(in_unit("1m:50cm:3m", "m", ""), "1:0.5:3");
  EXPECT_EQ(in_unit("1,2,5cm", "m", ""), "0.01,0.02,0.05");
  EXPECT_EQ(in_unit("1:20m", "m", ""), "1:20");
}

TEST(Quantity, MayHaveNoUnit) {
  for (const std::string text : {"3", "1:0.5:20", "1,2,5", "", "true", "1e400", "*", "1::2", "m"}) {
    EXPECT_FALSE(has_unit(text)) << text;
    EXPECT_EQ(in_unit(text, "m", ""), text);
  }
  EXPECT_TRUE(has_unit("1,2m"));
}

TEST(Quantity, OfAnotherUnitIsRefused) {
  EXPECT_EQ(why_not("3s", "m", "range"), "range (\"s\" is no m) write the number in m");
  EXPECT_EQ(why_not("3kdB", "dB", "gain"), "gain (\"kdB\" is no dB) write the number in dB");
  EXPECT_EQ(why_not("8 frames", "1", "stop"),
            "stop (it has no unit, so none that is \"frames\") write the number alone");
  EXPECT_EQ(why_not("1m,2,3m", "m", "range"),
            "range (\"2\" has no unit, others have) write a unit behind each number, or behind the "
            "last alone");
  EXPECT_EQ(why_not("1m:x", "m", "range"),
            "range (\"x\" is not a number) write numbers, each with its unit");
}

}  // namespace
