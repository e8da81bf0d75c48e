// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cfpm {

/// Options "keyword value" of a host's command, which may stand anywhere behind its first words.
class KeywordOptions {
public:
  using Fail = std::function<void(const std::string &)>;

  /// fail: ends the run with that message, and does not return.
  KeywordOptions(std::vector<std::string> &arguments, std::size_t first, Fail fail)
      : arguments_(arguments), first_(first), fail_(std::move(fail)) {}

  bool has(const std::string &keyword) const {
    return std::find(begin(), arguments_.end(), keyword) != arguments_.end();
  }

  /// Takes a keyword and its value out; empty without it.
  std::optional<std::string> take(const std::string &keyword, const std::string &expected) {
    const auto at = std::find(begin(), arguments_.end(), keyword);
    if (at == arguments_.end()) return std::nullopt;
    if (at + 1 == arguments_.end()) fail("missing value after '" + keyword + "'; expected " + expected);
    if (std::find(at + 1, arguments_.end(), keyword) != arguments_.end())
      fail("'" + keyword + "' given twice; expected it once");
    std::string value = at[1];
    arguments_.erase(at, at + 2);
    return value;
  }

  void fail(const std::string &what) const { fail_(what); }

private:
  std::vector<std::string>::iterator begin() const { return arguments_.begin() + static_cast<std::ptrdiff_t>(first_); }

  std::vector<std::string> &arguments_;
  std::size_t first_;
  Fail fail_;
};

} // namespace cfpm
