#pragma once
// Senders: the devices of an arena one by one, as a scenario's [devices.NAME] tables place them.
#include <cstdint>
#include <string>
#include <vector>

#include "channel/emitter.hpp"
#include "dsp/units.hpp"
#include "sim/arena/message_queue.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/random_spells.hpp"

namespace sim {

struct Sender {
  std::string name;         // "charger", or "charger-3" of several
  std::string kind;         // "charger"
  int number = 1;           // in its kind
  std::uint32_t point = 0;  // names its random numbers, as a point names those of a trial
  // Light.
  double x_m, y_m, height_m;
  dsp::Radians yaw;
  int leds;
  channel::EmitterData emitter;
  dsp::Amperes current;
  dsp::Hertz carrier;  // its true frequency
  double duty;
  // Messages.
  dsp::Hertz baud;        // its true rate
  dsp::Seconds pulse{0};  // of light, for each zero bit; 0: the whole bit
  MessageSource source;
  std::vector<std::string> messages;
  dsp::Seconds status_hold;
  dsp::Seconds interval_min, interval_max;
  std::vector<dsp::Seconds> intervals;  // in turn, instead of those two
  SpellTimes silence;
};

/// All devices of a scenario; places, directions and clock errors of several of a kind are drawn
/// from its seed. Throws bad_input for a message that does not fit its source.
std::vector<Sender> make_senders(const Scenario& scenario);

}  // namespace sim
