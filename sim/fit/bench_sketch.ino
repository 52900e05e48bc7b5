//
// For an Arduino Uno or Nano (ATmega328P, 16 MHz). wiring.svg shows the wires, README.txt what to do. The light L is
// on while it runs.
//
// One clock for all. Timer 1 makes the carrier on pin D10 (fast PWM, TOP in OCR1A) and never stops; its input capture
// stamps the edges of the module's output on D8 to 1/16 us, whatever the program does at that moment. Times are clocks
// since the timer was started; those of the plan are the same.
//
// Light. The LED's anode is at D10. Its cathode has a resistor each to D4, D5 and D6: one of them is low and the
// others are open, or all are open and it is dark. They are switched by an interrupt at the end of each pulse, of
// which the first instructions set what was decided a cycle before. So a switch is some 45 clocks behind the end of
// a pulse, 135 where an edge was just stamped, and the next pulse comes 160 clocks or more after the end of the last:
// no pulse is cut, and the number of pulses in a burst is exact. Levels between those of the resistors are shorter
// pulses: the module's band-pass sees the fundamental, sin(pi width / period).
//
// Serial line. An edge is a row of 14 characters, 0.28 ms at 500000 bits a second, so 3500 edges a second can last,
// and no train of a plan has more. What comes faster for a while waits in a ring of 128 (512 bytes of the 2 KB of
// memory). If that is full, pairs of edges are left out, and the last line says how many. The line is polled and has
// no interrupt, so it never delays the light.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>
#include <stdint.h>
#include <string.h>
#include <util/delay.h>

struct Step {
  uint16_t period;   // clocks a carrier cycle
  uint16_t width;    // clocks of which are a pulse
  uint8_t pin;       // of port D, as a bit
  uint32_t lead;     // carrier cycles of dark before the first burst, and one
  uint32_t on;       // carrier cycles a burst
  uint16_t off;      // carrier cycles of dark behind each
  uint16_t repeats;  // bursts; 0: the end
};

const Step steps[] PROGMEM = {
// STEPS
};

const uint8_t module_pin = 1 << 0, carrier_pin = 1 << 2, running_pin = 1 << 5;          // of port B: D8, D10, D13
const uint8_t level_pins = 1 << 4 | 1 << 5 | 1 << 6, mark_pin = 1 << 7;                // of port D: D4 to D6, D7

// The step that is played, and the next one, which the program has fetched long before. For the interrupts, but for
// what is volatile.
static Step fetched[2];
static Step* step = &fetched[0];
static Step* volatile next_step = &fetched[1];
static volatile bool has_next = false;
static volatile bool is_over = false;
static uint16_t period = 0;
static uint32_t left = 1;  // carrier cycles
static bool is_lit = false;
static uint8_t next_directions = mark_pin, next_levels = 0;  // of port D, for the next cycle

// Clocks at the beginning of the carrier cycle of which the interrupt was last, and of the one behind it.
static uint32_t this_start = 0;
static volatile uint32_t next_start = 0;

// Edges that are not sent yet, as clocks. Levels take turns.
const uint8_t places = 128;
static volatile uint32_t edges[places];
static volatile uint8_t first_edge = 0, behind_last_edge = 0;
static volatile uint16_t lost_edges = 0;
static volatile uint8_t level = 0;

static void fetch_next() {
  static const Step* next = steps;
  if (has_next || next == steps + sizeof(steps) / sizeof(*steps)) return;
  memcpy_P(next_step, next++, sizeof(Step));
  has_next = true;
}

// OCR1A and OCR1B are taken over by the timer when its cycle ends: they come first, to be in time for this one.
static inline void begin_step() {
  Step* const begun = next_step;
  OCR1B = begun->width - 1;
  period = begun->period;
  OCR1A = period - 1;
  left = begun->lead;
  next_step = step;
  step = begun;
  has_next = false;
}

// At the end of each pulse, so while it is dark. Where all is done it may be interrupted, so that an edge never waits
// for a carrier cycle.
ISR(TIMER1_COMPB_vect) {
  DDRD = next_directions;
  PORTD = next_levels;
  this_start = next_start;
  next_start = this_start + period;
  if (--left != 0) {
    sei();
    return;
  }
  if (is_lit) {
    next_directions = mark_pin;
    next_levels = 0;
    is_lit = false;
    --step->repeats;
    left = step->off;
  } else if (step->repeats != 0) {
    next_directions = step->pin | mark_pin;
    next_levels = mark_pin;
    is_lit = true;
    left = step->on;
  } else if (has_next) {
    begin_step();
  } else {
    is_over = true;
  }
  sei();
}

// An edge of the module's output. Which cycle it belongs to is told by whether that cycle's interrupt has been: this
// one comes first where both wait. The rest may be interrupted, so that the light is not late.
ISR(TIMER1_CAPT_vect) {
  const uint16_t at = ICR1, before = TCNT1;
  const bool waits = TIFR1 & 1 << OCF1B;  // of the same cycle, if that is not over behind it
  const uint16_t behind = TCNT1;
  const bool is_of_this = behind < at || (before > OCR1B && !waits);
  const uint32_t when = (is_of_this ? this_start : next_start) + at;
  sei();
  const uint8_t is = PINB & module_pin;
  if (is == level) return;  // shorter than this interrupt: no edge of a module
  const uint8_t next = (behind_last_edge + 1) % places;
  if (next == first_edge) {
    ++lost_edges;
    return;
  }
  level = is;
  edges[behind_last_edge] = when;
  behind_last_edge = next;
  TCCR1B ^= 1 << ICES1;
}

static void send(char c) {
  while (!(UCSR0A & 1 << UDRE0)) {
  }
  UDR0 = c;
}

static void say(const char* text) {
  while (*text) send(*text++);
}

// Subtracts powers of ten: a tenth of the time that divisions take.
static void send_digits(uint32_t value, uint32_t power) {
  static const uint32_t powers[] PROGMEM = {1000000, 100000, 10000, 1000, 100, 10, 1};
  for (uint8_t i = 0; i < sizeof(powers) / sizeof(*powers); ++i) {
    const uint32_t one = pgm_read_dword(&powers[i]);
    if (one > power) continue;
    char digit = '0';
    for (; value >= one; value -= one) ++digit;
    send(digit);
  }
}

// Clocks are counted in 32 bits, which are 268 s; so seconds are counted beside them.
const uint32_t second = 16000000;
static uint16_t seconds = 0;
static uint32_t second_start = 0;

static void send_row(uint32_t clocks, uint8_t is) {
  uint16_t whole = seconds;
  uint32_t rest = clocks - second_start;
  for (; rest >= second; rest -= second) ++whole;
  send_digits(whole, 1000);
  send('.');
  send_digits(rest * 5 / 8, 1000000);  // 1/16 us as 0.1 us
  send(',');
  send(is ? '1' : '0');
  send('\n');
}

static uint8_t told;  // the level of the last row

void setup() {
  cli();
  TIMSK0 = TIMSK2 = 0;  // Arduino's clock would delay the light
  UCSR0A = 1 << U2X0;
  UBRR0 = 3;
  UCSR0C = 3 << UCSZ00;
  UCSR0B = 1 << TXEN0;
  PORTD = 0;
  DDRD = mark_pin;
  DDRB = carrier_pin | running_pin;
  PORTB = module_pin | running_pin;  // a pull-up, should the module have none
  _delay_ms(2000);                   // the module has its power
  TCCR1A = TCCR1B = 0;
  fetch_next();
  begin_step();
  level = told = PINB & module_pin;
  say("time_s,rx\n");
  send_row(0, told);
  TCNT1 = 0;
  TIFR1 = 0xff;
  TIMSK1 = 1 << ICIE1 | 1 << OCIE1B;
  TCCR1A = 1 << COM1B1 | 1 << WGM11 | 1 << WGM10;
  TCCR1B = 1 << WGM13 | 1 << WGM12 | (told ? 0 : 1 << ICES1) | 1 << CS10;
  sei();
}

static void end_all(uint32_t now) {
  TIMSK1 = 0;
  TCCR1A = TCCR1B = 0;
  send_row(now, told);
  if (lost_edges) {
    say("# pairs of edges lost: ");
    send_digits(lost_edges, 10000);
    send('\n');
  }
  _delay_ms(1);
  PORTB = 0;
  cli();
  set_sleep_mode(SLEEP_MODE_PWR_DOWN);
  sleep_enable();
  for (;;) sleep_cpu();
}

void loop() {
  fetch_next();
  const bool was_over = is_over;
  cli();
  const uint32_t now = next_start;
  sei();
  if (first_edge != behind_last_edge) {
    told ^= module_pin;
    send_row(edges[first_edge], told);
    first_edge = (first_edge + 1) % places;
    return;
  }
  if (now - second_start >= 2 * second) {
    second_start += second;
    ++seconds;
  }
  if (was_over) end_all(now);
}

#ifndef ARDUINO
int main() {
  setup();
  for (;;) loop();
}
#endif
