// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/deck/restart_command.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace cfpm {
namespace {

using Words = std::vector<std::string>;

constexpr auto alone = [](void *, int) {}; // one rank has nobody to tell

/// What is read from a file of these bytes.
Words read_from(const std::string &bytes) {
  std::FILE *file = std::tmpfile();
  std::fwrite(bytes.data(), 1, bytes.size(), file);
  std::rewind(file);
  const Words words = read_command(file, alone);
  std::fclose(file);
  return words;
}

std::string bytes_of(int length, const std::string &text) {
  return std::string(reinterpret_cast<const char *>(&length), sizeof length) + text;
}

TEST(RestartCommand, ComesBackAsItWasGiven) {
  const Words words{"hooke", "2e5", "NULL", "", "predict", "impulse"};
  std::FILE *file = std::tmpfile();
  write_command(words, file);
  std::fputs("what follows", file);
  std::rewind(file);
  EXPECT_EQ(read_command(file, alone), words);
  EXPECT_EQ(std::fgetc(file), 'w');
  std::fclose(file);
}

TEST(RestartCommand, IsToldToOtherRanks) {
  const std::string text("a\0bc\0", 5);
  int calls = 0;
  const Words words = read_command(nullptr, [&](void *data, int bytes) {
    if (calls++ == 0) {
      *static_cast<int *>(data) = 5;
    } else {
      ASSERT_EQ(bytes, 5);
      text.copy(static_cast<char *>(data), 5);
    }
  });
  EXPECT_EQ(words, (Words{"a", "bc"}));
}

TEST(RestartCommand, CarriesTheStep) {
  Words words = with_step({"hooke", "predict"}, 1e-5 / 3.0);
  EXPECT_EQ(take_step(words), 1e-5 / 3.0);
  EXPECT_EQ(words, (Words{"hooke", "predict"}));
  EXPECT_EQ(take_step(words), 0.0); // of a file that holds none
  EXPECT_EQ(words, (Words{"hooke", "predict"}));
  Words none;
  EXPECT_EQ(take_step(none), 0.0);
}

TEST(RestartCommand, OfAnotherStyleIsNone) {
  EXPECT_EQ(read_from(bytes_of(2, std::string("a\0", 2))), Words{"a"});
  EXPECT_EQ(read_from(""), Words{});
  EXPECT_EQ(read_from(bytes_of(0, "")), Words{});
  EXPECT_EQ(read_from(bytes_of(-1, "a")), Words{});
  EXPECT_EQ(read_from(bytes_of(3, "ab")), Words{});                             // ends too early
  EXPECT_EQ(read_from(bytes_of(3, "abc")), Words{});                            // no word ends
  EXPECT_EQ(read_from(bytes_of(1 << 20, std::string(1 << 20, '\0'))), Words{}); // longer than any command
}

} // namespace
} // namespace cfpm
