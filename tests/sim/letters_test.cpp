// Texts that are cut where they are too long.
#include "sim/text/letters.hpp"

#include <gtest/gtest.h>

namespace sim {
namespace {

TEST(TextLetters, AreCountedAsReadersSeeThem) {
  EXPECT_EQ(letters_in(""), 0U);
  EXPECT_EQ(letters_in("IND\u24230"), 5U);
}

TEST(TextLetters, AreLeftOutAtTheEndOfWhatIsTooLong) {
  EXPECT_EQ(shortened("IND\u24230", 5), "IND\u24230");
  EXPECT_EQ(shortened("\u2423\u2423\u2423\u2423\u2423\u2423", 5), "\u2423\u2423...");
  EXPECT_EQ(shortened("abcdef", 3), "...");
}

}  // namespace
}  // namespace sim
