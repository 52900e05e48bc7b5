#!/usr/bin/env python3
"""A sound decoder of COSYS messages, and broken ones, each with one mistake that people make.

It reads a VCD of one wire and prints each message that it accepts, a line each. It is written from the protocol's
document and the VCD standard, and has none of the program's code. A mutant changes one number or one rule of the sound
decoder: its name and its mistake are those of its class.

Usage: mutants.py [--mutant NAME] CAPTURE.vcd
       mutants.py --list
For check: --decoder 'mutants.py --mutant NAME {vcd}' --decoder-output frames
"""
import argparse
import bisect
import collections
import re
import sys

NEWLINE = ord("\n")
STOP_SLOT = 9  # slot 0 is the start bit, 1 to 8 are data
SHORTEST_PAUSE = 100e3  # us between two messages of a device

Character = collections.namedtuple("Character", "start value has_stop_bit")


class Wire:
    """The level of a wire over time in microseconds; it begins idle, at 1."""

    def __init__(self, edges):
        self.times = [time for time, _ in edges]
        self.levels = [level for _, level in edges]
        self.falls = [time for time, level in edges if not level]

    def level(self, time):
        edge = bisect.bisect_right(self.times, time) - 1
        return self.levels[edge] if edge >= 0 else 1

    def next_fall(self, behind):
        fall = bisect.bisect_right(self.falls, behind)
        return self.falls[fall] if fall < len(self.falls) else None


def edges_of(vcd):
    """(time, level) of each change. The capture has one wire, and ticks of a microsecond."""
    time, last = 0, 1
    for word in vcd[vcd.index("$enddefinitions"):].split():
        if word[0] == "#":
            time = int(word[1:])
        elif word[0] in "01" and int(word[0]) != last:
            last = int(word[0])
            yield time, last


class Sound:
    """One sample in the middle of each bit; a line ends at a newline and is judged by its checksum."""

    bit = 1e6 / 600
    sample_at = 0.5  # in a bit
    longest_line = 256

    def __init__(self):
        self.line = bytearray()

    def messages(self, edges):
        for character in self.characters(Wire(self.cleaned(edges))):
            message = self.take(character)
            if message is not None:
                yield message

    def cleaned(self, edges):
        return edges

    # Edges to characters.

    def characters(self, wire):
        start = wire.next_fall(-1)
        while start is not None:
            if self.is_start_bit(wire, start):
                yield self.character(wire, start)
                start = self.next_start(wire, self.end_of_character(start))
            else:
                start = self.next_start(wire, self.sample_time(start, 0))

    def next_start(self, wire, behind):
        return wire.next_fall(behind)

    def is_start_bit(self, wire, start):
        return not wire.level(self.sample_time(start, 0))

    def character(self, wire, start):
        levels = [wire.level(self.sample_time(start, slot)) for slot in range(1, STOP_SLOT + 1)]
        return Character(start, self.byte_of(levels[:-1]), levels[-1])

    def sample_time(self, start, slot):
        return start + (slot + self.sample_at) * self.bit

    def end_of_character(self, start):
        """From when on the next one may start: the middle of the stop bit, as the other clock may be faster."""
        return self.sample_time(start, STOP_SLOT)

    def byte_of(self, bits):
        return sum(bit << place for place, bit in enumerate(bits))

    # Characters to messages.

    def take(self, character):
        """The message that a character completes, if any. One without a stop bit counts: the checksum judges."""
        if character.value == NEWLINE:
            return self.end_line()
        self.add(character.value)
        return None

    def add(self, value):
        if len(self.line) < self.longest_line:
            self.line.append(value)

    def end_line(self):
        line = bytes(self.line)
        self.line.clear()
        message = self.message_of(line) if len(line) < self.longest_line else None
        if message is None and line:
            self.refused(line)
        return message

    def refused(self, line):
        """Nothing is kept of a bad line. An empty one is none."""

    def message_of(self, line):
        """What stands ahead of the last space, where the line is printable and its checksum is right."""
        message, space, digits = line.rpartition(b" ")
        if not space or not self.is_printable(line) or not self.is_hex(digits):
            return None
        return message if self.is_right(digits, message) else None

    def is_printable(self, line):
        return all(0x20 <= byte <= 0x7E for byte in line)

    def is_hex(self, digits):
        return re.fullmatch(rb"[0-9A-Fa-f]{2}", digits)

    def is_right(self, digits, message):
        return int(digits, 16) == self.checksum(message)

    def checksum(self, message):
        xor = 0
        for byte in message:
            xor ^= byte
        return xor


# Mistakes with time.


class SamplesAtTheEdge(Sound):
    """Reads a bit where it begins: half a bit is forgotten behind the start's edge."""

    sample_at = 0


class SamplesEarly(Sound):
    """Reads a bit in its first quarter: the start's edge is taken for late, as by a slow interrupt."""

    sample_at = 0.2


class SamplesLate(Sound):
    """Reads a bit in its last quarter: what the interrupt takes comes on top of half a bit."""

    sample_at = 0.8


class BaudTwoPercentOff(Sound):
    """A divisor that is rounded: 612 Bd."""

    bit = 1e6 / 612


class DriftsOverACharacter(Sound):
    """Waits for a bit after each bit, and what it does besides takes 40 us."""

    def sample_time(self, start, slot):
        return super().sample_time(start, slot) + slot * 40


class NoStartBitCheck(Sound):
    """Takes any fall for a start bit, that of a flash too."""

    def is_start_bit(self, wire, start):
        return True


class WaitsOutTheStopBit(Sound):
    """Listens again when the stop bit is nearly over: a faster device has begun the next character."""

    def end_of_character(self, start):
        return start + 9.9 * self.bit


class MostSignificantBitFirst(Sound):
    """The order of bits that SPI has."""

    def byte_of(self, bits):
        return super().byte_of(bits[::-1])


class Debounces(Sound):
    """Takes pulses of less than 1.6 ms for bouncing, though a bit may be as short."""

    def cleaned(self, edges):
        kept = []
        for edge in edges:
            if kept and edge[0] - kept[-1][0] < 1600:
                kept.pop()
            else:
                kept.append(edge)
        return kept


class DeafBehindALine(Sound):
    """Tells of each line by a slow serial port of its own, for 40 ms, and hears nothing meanwhile."""

    deaf_until = -1

    def next_start(self, wire, behind):
        return super().next_start(wire, max(behind, self.deaf_until))

    def take(self, character):
        if character.value == NEWLINE and self.line:
            self.deaf_until = character.start + 10 * self.bit + 40e3
        return super().take(character)


# Mistakes with checksums.


class ChecksumIgnored(Sound):
    """Looks whether there is a checksum, and not which."""

    def is_right(self, digits, message):
        return True


class ChecksumOfOneDigit(Sound):
    """Compares the last digit alone."""

    def is_right(self, digits, message):
        return int(digits, 16) % 16 == self.checksum(message) % 16


class ChecksumWithTheSpace(Sound):
    """Takes the space ahead of the checksum into it."""

    def checksum(self, message):
        return super().checksum(message + b" ")


class UpperCaseChecksumAlone(Sound):
    """Compares text, and writes its own checksum in upper case."""

    def is_hex(self, digits):
        return re.fullmatch(rb"[0-9A-F]{2}", digits)


# Mistakes with lines.


class SaysEachMessageTwice(Sound):
    """Hands out its buffer at the newline, and again where it is cleared."""

    def messages(self, edges):
        for message in super().messages(edges):
            yield message
            yield message


class NotClearedAfterABadLine(Sound):
    """Clears its buffer where a message is accepted, and only there."""

    def refused(self, line):
        self.line.extend(line)


class DropsTheLineBehindABadOne(Sound):
    """Clears its mark of an error too late: when the next line has ended."""

    drops = False

    def end_line(self):
        dropped, self.drops = self.drops, False
        message = super().end_line()
        return None if dropped else message

    def refused(self, line):
        self.drops = True


class DeadAfterAFramingError(Sound):
    """Never leaves the state of an error."""

    is_dead = False

    def take(self, character):
        self.is_dead = self.is_dead or not character.has_stop_bit
        return None if self.is_dead else super().take(character)


class WaitsForAPauseAfterABadLine(Sound):
    """Hears again behind the shortest pause of a device, though others may send."""

    end_of_last, waits = 0, False

    def take(self, character):
        pause = character.start - self.end_of_last
        self.end_of_last = character.start + 10 * self.bit
        self.waits = self.waits and pause < SHORTEST_PAUSE
        return None if self.waits else super().take(character)

    def refused(self, line):
        self.waits = True


class OneMessageABurst(Sound):
    """Takes three characters of silence for the end of a message, and of what came without the first line alone."""

    end_of_last, is_full = 0, False

    def take(self, character):
        if character.start - self.end_of_last > 30 * self.bit:
            self.line.clear()
            self.is_full = False
        self.end_of_last = character.start + 10 * self.bit
        return None if self.is_full else super().take(character)

    def end_line(self):
        self.is_full = len(self.line) > 0
        return super().end_line()


class AcceptsShortLines(Sound):
    """Asks for a checksum where there is room for one."""

    def message_of(self, line):
        return super().message_of(line) if len(line) > 3 else line or None


class KeepsLeadingGarbage(Sound):
    """Judges a line from the device's name on, and gives out all of it."""

    def message_of(self, line):
        name = max(0, line.find(b"IND"))
        message = super().message_of(line[name:])
        return None if message is None else line[:name] + message


class ShortBuffer(Sound):
    """Has room for the longest message that it knows, and an overlong line takes the next with it."""

    longest_line = 17
    drops = False

    def end_line(self):
        dropped, self.drops = self.drops, len(self.line) >= self.longest_line
        message = super().end_line()
        return None if dropped else message


def name_of(decoder):
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=A)(?=[A-Z])", "-", decoder.__name__).lower()


DECODERS = {name_of(decoder): decoder for decoder in [Sound, *Sound.__subclasses__()]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mutant", choices=DECODERS, default="sound")
    parser.add_argument("--list", action="store_true", help="print the names")
    parser.add_argument("capture", nargs="?")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(DECODERS))
        return
    with open(arguments.capture, encoding="ascii") as file:
        edges = list(edges_of(file.read()))
    for message in DECODERS[arguments.mutant]().messages(edges):
        sys.stdout.buffer.write(message + b"\n")


main()
