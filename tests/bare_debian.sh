#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Shows that the two commands need nothing by hand, and what the plugins do on every Debian: a fresh clone of HEAD in
# bare systems, and a table of them, FOLDER/hosts.md.
# usage, as root: tests/bare_debian.sh FOLDER [SUITE ...]   (default: bookworm trixie forky)
# COMMANDS="demo" leaves the tests out; default: "demo test", on forky "build" and the table's probe alone.
set -euo pipefail

if [ $# -lt 1 ] || [ "$(id -u)" -ne 0 ]; then
  echo "usage, as root: tests/bare_debian.sh FOLDER [SUITE ...]" >&2
  exit 2
fi
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- bookworm trixie forky
here=$(cd "$(dirname "$0")" && pwd)
failed=0
results=()
for suite in "$@"; do
  inside() { "$here/debian/in_bare_debian.sh" "$folder" "$suite" "$@"; }
  inside true
  rm -rf "$folder/$suite/root/cfpm"
  git clone -q "$here/.." "$folder/$suite/root/cfpm"
  commands=${COMMANDS:-demo test}
  [ "$suite" != forky ] || commands=build
  result=$folder/$suite-results
  rm -rf "$result"
  mkdir -p "$result"
  for command in $commands; do
    echo "=== ./cfpm $command in a bare $suite"
    inside cfpm/cfpm "$command" 2>&1 | tee "$result/$command.log" || failed=1
  done
  echo "=== hosts of $suite"
  inside cfpm/cfpm build
  if inside python3 cfpm/tests/debian/probe.py >"$result/probe.json"; then results+=("$suite=$result"); else failed=1; fi
done
"${PYTHON:-/usr/bin/python3}" "$here/debian/table.py" "${results[@]}" | tee "$folder/hosts.md"
exit $failed
