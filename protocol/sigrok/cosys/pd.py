"""Written for cosys-sim; libsigrokdecode, which loads it, is under the GPL, version 3 or later."""

import sigrokdecode as srd

RX = 0

# In the order of CosysOutcome (protocol/cosys.hpp); then what a line is marked with on the way.
OK, UNPRINTABLE, TOO_SHORT, NOT_HEX, WRONG_CHECKSUM, OVERLONG, NO_NEWLINE, FRAMING_ERROR = range(8)
NAMES = ('ok', 'unprintable', 'too_short', 'not_hex', 'wrong_checksum', 'overlong', 'no newline',
         'framing error')

TAIL_SIZE = 3  # space and two digits
HEX_DIGITS = b'0123456789abcdefABCDEF'


def is_printable(byte):
    return 0x20 <= byte <= 0x7e


def checksum(message):
    xor = 0
    for byte in message:
        xor ^= byte
    return xor


def judge(line):
    """The outcome of a line without its newline."""
    if not all(is_printable(byte) for byte in line):
        return UNPRINTABLE
    space = line.rfind(b' ')
    if space < 0 or len(line) - space < TAIL_SIZE:
        return TOO_SHORT
    digits = line[space + 1:]
    if len(digits) != 2 or not all(digit in HEX_DIGITS for digit in digits):
        return NOT_HEX
    return OK if int(digits, 16) == checksum(line[:space]) else WRONG_CHECKSUM


def escaped(line):
    """As cosys-sim shows bytes: on one line, and those that no terminal shows as \\xNN."""
    return ''.join('\\\\' if byte == 0x5c else chr(byte) if is_printable(byte)
                   else '\\x%02x' % byte for byte in line)


class Decoder(srd.Decoder):
    api_version = 3
    id = 'cosys'
    name = 'COSYS'
    longname = 'COSYS infrared messages'
    desc = 'Messages of COSYS devices over 59 kHz infrared light.'
    license = 'gplv3+'
    inputs = ['uart']
    outputs = []
    tags = ['IR']
    options = (
        {'id': 'max_line', 'desc': 'Longest line in bytes, newline included', 'default': 256},
    )
    annotations = (
        ('ok', 'Message'),
        ('unprintable', 'Byte outside printable ASCII'),
        ('too_short', 'No room for a checksum'),
        ('not_hex', 'Checksum that is not two hex digits'),
        ('wrong_checksum', 'Wrong checksum'),
        ('overlong', 'No newline within the limit'),
        ('no_newline', 'Line that has not ended'),
        ('framing_error', 'Byte without a stop bit'),
    )
    annotation_rows = (
        ('messages', 'Messages', (OK,)),
        ('refused', 'Refused', (UNPRINTABLE, TOO_SHORT, NOT_HEX, WRONG_CHECKSUM, OVERLONG)),
        ('unended', 'Not ended', (NO_NEWLINE,)),
        ('bytes', 'Bytes', (FRAMING_ERROR,)),
    )
    binary = (
        ('messages', 'Accepted messages, a line each'),
    )

    def __init__(self):
        self.reset()

    def reset(self):
        self.line = bytearray()
        self.ss = self.es = 0        # of the line
        self.unmarked_ss = None      # of its first byte behind the last silence
        self.dropping = False        # inside the rest of an overlong line
        self.is_false_start = False  # the next FRAME is none

    def start(self):
        self.out_ann = self.register(srd.OUTPUT_ANN)
        self.out_binary = self.register(srd.OUTPUT_BINARY)

    def decode(self, ss, es, data):
        kind, rxtx, value = data
        if rxtx != RX:
            return
        if kind == 'INVALID STARTBIT':
            self.is_false_start = True
        elif kind == 'FRAME' and self.is_false_start:
            self.is_false_start = False
        elif kind == 'FRAME':
            self.take_byte(ss, es, *value)
        elif kind == 'IDLE' and self.unmarked_ss is not None:
            self.mark_unended()

    def take_byte(self, ss, es, byte, has_stop_bit):
        """A byte with a framing error counts by its value: the checksum judges."""
        if not has_stop_bit:
            self.put(ss, es, self.out_ann, [FRAMING_ERROR, ['framing error: %02x' % byte, 'FE']])
        is_newline = byte == 0x0a
        if self.dropping:
            self.dropping = not is_newline
            return
        if not self.line:
            self.ss = ss
        if self.unmarked_ss is None:
            self.unmarked_ss = ss
        self.es = es
        if is_newline:
            self.end_line(judge(bytes(self.line)))
            return
        self.line.append(byte)
        if len(self.line) >= self.options['max_line']:
            self.dropping = True
            self.end_line(OVERLONG)

    def end_line(self, outcome):
        line, self.line = bytes(self.line), bytearray()
        self.unmarked_ss = None
        if outcome != OK:
            self.annotate(self.ss, outcome, line)
            return
        message = line[:-TAIL_SIZE]
        self.annotate(self.ss, OK, message)
        self.put(self.ss, self.es, self.out_binary, [0, message + b'\n'])

    def mark_unended(self):
        """The line so far. A newline may be on its way yet: nobody tells a decoder of the end."""
        self.annotate(self.unmarked_ss, NO_NEWLINE, self.line)
        self.unmarked_ss = None

    def annotate(self, ss, outcome, line):
        text, name = escaped(line), NAMES[outcome]
        self.put(ss, self.es, self.out_ann,
                 [outcome, ['%s: %s' % (name, text), text if outcome == OK else name]])
