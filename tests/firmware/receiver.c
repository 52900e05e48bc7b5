/* A receiver of COSYS messages on an ATmega328P, written from the protocol's document and not from this project's
 * code: simavr runs it on the wires that `trace` writes. The module's output is at INT0 (pin PD2). A fall starts a
 * character, Timer1 then reads the pin in the middle of each bit (600 Bd, 8N1, least significant bit first). Of every
 * line it says by its own UART "ok MESSAGE" or "bad", as it finds the checksum.
 */
#include <avr/interrupt.h>
#include <avr/io.h>

enum { bit_ticks = F_CPU / 600, longest_line = 256 };

static volatile uint8_t received[16]; /* a ring: 16 characters are 0.27 s */
static volatile uint8_t first, behind_last;
static uint8_t slot, value; /* of the character under way: 0 is its start bit */

static uint8_t pin(void) { return (PIND >> PD2) & 1; }

static void await_fall(void) {
  TIMSK1 = 0;
  EIFR = 1 << INTF0;
  EIMSK = 1 << INT0;
}

ISR(INT0_vect) {
  EIMSK = 0;
  TCNT1 = 0;
  OCR1A = bit_ticks / 2;
  TIFR1 = 1 << OCF1A;
  TIMSK1 = 1 << OCIE1A;
  slot = value = 0;
}

ISR(TIMER1_COMPA_vect) {
  const uint8_t level = pin();
  OCR1A += bit_ticks;
  if (slot == 0 && level) { /* a flash, no start bit */
    await_fall();
  } else if (slot < 9) {
    if (slot > 0) value = value >> 1 | level << 7;
    ++slot;
  } else { /* the stop bit, whatever it is: the checksum judges */
    received[behind_last] = value;
    behind_last = (behind_last + 1) % sizeof(received);
    await_fall();
  }
}

static void say(const char *text) {
  for (; *text; ++text) {
    while (!(UCSR0A & 1 << UDRE0)) {
    }
    UDR0 = *text;
  }
}

static int8_t hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  c |= 0x20;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Ends the message at the space before its checksum, if that is right. */
static uint8_t is_message(char *line, int16_t size) {
  const int16_t space = size - 3;
  uint8_t sum = 0;
  if (space < 0 || line[space] != ' ' || hex(line[space + 1]) < 0 || hex(line[space + 2]) < 0) return 0;
  for (int16_t i = 0; i < space; ++i) {
    if (line[i] < ' ' || line[i] > '~') return 0;
    sum ^= (uint8_t)line[i];
  }
  line[space] = 0;
  return sum == (hex(line[space + 1]) << 4 | hex(line[space + 2]));
}

static void take(char character) {
  static char line[longest_line];
  static int16_t size;
  if (character != '\n') {
    if (size < longest_line) line[size++] = character;
    return;
  }
  const uint8_t good = size < longest_line && is_message(line, size);
  say(good ? "ok " : "bad");
  if (good) say(line);
  say("\n");
  size = 0;
}

int main(void) {
  UCSR0A = 1 << U2X0;
  UBRR0 = 0;
  UCSR0B = 1 << TXEN0;
  TCCR1B = 1 << CS10;
  EICRA = 1 << ISC01;
  await_fall();
  sei();
  for (;;) { /* awake: simavr keeps real time with a processor that sleeps */
    while (first == behind_last) {
    }
    take((char)received[first]);
    first = (first + 1) % sizeof(received);
  }
}
