# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a command and writes into a file how much memory it held at most [kB].

python3 -S peak.py FILE COMMAND ...

Started by a larger process a command would be said to hold that much, as the system hands on the count.
"""

import os
import sys

pid = os.spawnvp(os.P_NOWAIT, sys.argv[2], sys.argv[2:])
_, status, usage = os.wait4(pid, 0)
with open(sys.argv[1], "w") as file:
    file.write(str(usage.ru_maxrss))
sys.exit(os.waitstatus_to_exitcode(status))
