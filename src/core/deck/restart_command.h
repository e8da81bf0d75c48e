// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace cfpm {

/// The words of a pair style's command with, behind them, the step of the run that it was in [s]: hosts do not all keep
/// that in a restart file.
inline std::vector<std::string> with_step(std::vector<std::string> words, double dt) {
  char text[40];
  std::snprintf(text, sizeof text, "dt=%a", dt);
  words.emplace_back(text);
  return words;
}

/// Takes the step from behind the words; 0 if there is none [s].
inline double take_step(std::vector<std::string> &words) {
  if (words.empty() || words.back().rfind("dt=", 0) != 0) return 0.0;
  const double dt = std::strtod(words.back().c_str() + 3, nullptr);
  words.pop_back();
  return dt;
}

/// Writes the words of a pair style's command to a restart file. Hosts keep only some of the settings of their styles
/// there; here the whole command comes back.
inline void write_command(const std::vector<std::string> &words, std::FILE *file) {
  std::string text;
  for (const std::string &word : words) text += word + '\0';
  const int length = static_cast<int>(text.size());
  std::fwrite(&length, sizeof length, 1, file);
  std::fwrite(text.data(), 1, text.size(), file);
}

/// Reads them again; none if the file does not hold such a command. file: of the first rank alone, else null;
/// broadcast(data, bytes): from the first rank to all.
template <class Broadcast> std::vector<std::string> read_command(std::FILE *file, const Broadcast &broadcast) {
  constexpr int longest = 1 << 16; // anything else is not of this style
  int length = 0;
  std::string text;
  if (file) {
    bool readable = std::fread(&length, sizeof length, 1, file) == 1 && length > 0 && length < longest;
    text.resize(readable ? static_cast<std::size_t>(length) : 0);
    readable = readable && std::fread(text.data(), 1, text.size(), file) == text.size() && text.back() == '\0';
    if (!readable) length = 0;
  }
  broadcast(&length, static_cast<int>(sizeof length));
  text.resize(static_cast<std::size_t>(length));
  broadcast(text.data(), length);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size(); at += words.back().size() + 1) words.emplace_back(&text[at]);
  return words;
}

} // namespace cfpm
