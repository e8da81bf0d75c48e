# SPDX-License-Identifier: GPL-2.0-or-later
"""Where tests/mutations looks for the folders."""

from harness.host import BUILD, ROOT  # noqa: F401
