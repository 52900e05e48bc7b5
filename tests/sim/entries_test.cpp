// TOML text as a list of entries: what is one key, what may stand twice, and how deep a key may be.
#include "sim/scenario/entries.hpp"

#include <string>

#include "gtest/gtest.h"
#include "sim/failure.hpp"

namespace sim {
namespace {

std::string entries_refusal(const std::string& text,
                            const std::vector<std::string>& repeatable = {}) {
  try {
    read_entries(text, "x.toml", repeatable);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

const std::string too_deep = " (more than 250 dots in a key) shorten the key";

TEST(Entries, ManyDotsAreNoDeepKey) {
  const std::string decimals = repeated("0.5, ", 300), dots = repeated("a.", 300);
  EXPECT_EQ(entries_refusal("a = [" + decimals + "]"), "accepted");
  EXPECT_EQ(entries_refusal("a = \"" + decimals + "\""), "accepted");
  EXPECT_EQ(entries_refusal("a = '" + dots + "' # " + dots), "accepted");
  EXPECT_EQ(entries_refusal("a = \"\\\"" + dots + "\" # \"\n# " + dots), "accepted");
  EXPECT_EQ(entries_refusal("a = '''\n" + dots + "\n'''\nb = \"\"\"" + dots + "\\\"\"\"\"\n"),
            "accepted");
  EXPECT_EQ(entries_refusal("t = { " + repeated("a.b = 1, c.d = 2, ", 1) + "e.f = 3 }\n"),
            "accepted");
}

// The TOML library would run out of stack, whatever stands between the dots.
TEST(Entries, DeepKeysAreRefusedInEveryForm) {
  EXPECT_EQ(entries_refusal("\na" + repeated(".a", 100'000) + " = 1"),
            "syntax error in x.toml:2" + too_deep);
  EXPECT_EQ(entries_refusal("\n\n[a" + repeated(" . a", 100'000) + "]"),
            "syntax error in x.toml:3" + too_deep);
  for (const char* part : {".'='", ".\"\\\"=\"", ".\"a.=\"", ".'#'", ".\"\""})
    EXPECT_EQ(entries_refusal("a" + repeated(part, 100'000) + " = 1"),
              "syntax error in x.toml:1" + too_deep)
        << part;
  for (const char* before :
       {"a = '''\n'''''", "a = \"\"\"\\\"\"\"\"", "a = \"x\"# \"", "a = ''# '"})
    EXPECT_EQ(entries_refusal(std::string(before) + "\nb" + repeated(".'='", 100'000) + " = 1")
                  .substr(24),
              too_deep)
        << before;
}

TEST(Entries, AKeyMayHave250Dots) {
  EXPECT_EQ(entries_refusal("a" + repeated(".a", 250) + " = 1"), "accepted");
  EXPECT_EQ(entries_refusal("a" + repeated(".a", 251) + " = 1"),
            "syntax error in x.toml:1" + too_deep);
}

TEST(Entries, OnlyRepeatableTablesMayStandTwice) {
  const std::string twice = "[[a]]\nb = 1\n[[a]]\nb = 2\n";
  EXPECT_EQ(entries_refusal(twice),
            "a.b in x.toml:4 (given twice in this file) remove one of the two");
  EXPECT_EQ(entries_refusal(twice, {"a"}), "accepted");
  EXPECT_EQ(entries_refusal("[c]\n" + twice, {"c.a", "c"}),
            "c in x.toml:1 (not written as a table that may repeat) write [[c]]");
}

}  // namespace
}  // namespace sim
