// What simavr shall record of the sketch of `cosys-sim fit --plan`, to be included before it: the layout is that of
// simavr's avr_mcu_section.h (1.6), of which Debian has a package of its own. simavr calls a wire as is said here.
#include <avr/io.h>
#include <stdint.h>

struct WireTrace {
  uint8_t tag, size, mask;
  uint16_t what;
  char name[32];
} __attribute__((packed));

struct WireText {
  uint8_t tag, size;
  char text[64];
} __attribute__((packed));

struct WireNumber {
  uint8_t tag, size;
  uint32_t value;
} __attribute__((packed));

enum { is_mcu = 1, is_clock = 2, is_file = 12, is_period = 13, is_bit = 14, is_pin = 15, trace_size = 35 };
enum { directions_of_d = 0x2a };

#define IN_MMCU extern const __attribute__((section(".mmcu"), used))

extern "C" {
IN_MMCU WireText mcu_name = {is_mcu, 64, "atmega328p"};
IN_MMCU WireNumber mcu_clock = {is_clock, 4, 16000000};
IN_MMCU uint8_t _mmcu[2] = {0, 0};
IN_MMCU WireText vcd_name = {is_file, 64, "sketch.vcd"};
IN_MMCU WireNumber vcd_period_us = {is_period, 4, 1000};
IN_MMCU WireTrace carrier_wire = {is_pin, trace_size, 'B', 2, "carrier"};
IN_MMCU WireTrace mark_wire = {is_pin, trace_size, 'D', 7, "mark"};
IN_MMCU WireTrace sink_4 = {is_bit, trace_size, 1 << 4, directions_of_d, "d4"};
IN_MMCU WireTrace sink_5 = {is_bit, trace_size, 1 << 5, directions_of_d, "d5"};
IN_MMCU WireTrace sink_6 = {is_bit, trace_size, 1 << 6, directions_of_d, "d6"};
}
