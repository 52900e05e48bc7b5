"""COSYS messages behind libsigrokdecode's uart decoder: 600 baud, 8N1, idle high, light = 0.

A message is printable ASCII, a space, the XOR of what is before the space as two hex digits, and a
newline. Each line is shown as accepted or with the reason why not; the rules, the names and what is
shown of a line are those of protocol/cosys.hpp, so that this and `cosys-sim decode` agree.
"""

from .pd import Decoder
