// Letters of texts: how many, their case, and texts that are too long.
#include "sim/text/letters.hpp"

#include <gtest/gtest.h>

namespace sim {
namespace {

TEST(TextLetters, AreCountedAsReadersSeeThem) {
  EXPECT_EQ(letters_in(""), 0U);
  EXPECT_EQ(letters_in("IND\u24230"), 5U);
}

TEST(TextLetters, BeginASentenceWithACapital) {
  EXPECT_EQ(capitalised("long carriers"), "Long carriers");
  EXPECT_EQ(capitalised("9 of 10"), "9 of 10");
  EXPECT_EQ(capitalised("\u00fcber"), "\u00fcber");
  EXPECT_EQ(capitalised(""), "");
}

TEST(TextLetters, AreLeftOutAtTheEndOfWhatIsTooLong) {
  EXPECT_EQ(shortened("IND\u24230", 5), "IND\u24230");
  EXPECT_EQ(shortened("\u2423\u2423\u2423\u2423\u2423\u2423", 5), "\u2423\u2423...");
  EXPECT_EQ(shortened("abcdef", 3), "...");
}

}  // namespace
}  // namespace sim
