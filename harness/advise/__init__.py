# SPDX-License-Identifier: GPL-2.0-or-later
"""What a deck's setup says of its contacts, and which method and time step that supports: ./cfpm advise."""
