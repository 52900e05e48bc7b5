#include "sim/counting/tally_counters.hpp"

#include <array>

namespace sim {
namespace {

constexpr std::array counters{
    TallyCounter{"n_bits", "line bits sent", &Tally::n_bits},
    TallyCounter{"n_bit_errors", "line bits wrong at the centre of their slot, before any decoder",
                 &Tally::n_bit_errors},
    TallyCounter{"n_bytes", "characters sent", &Tally::n_bytes},
    TallyCounter{"n_byte_errors", "characters not received, or received as another",
                 &Tally::n_byte_errors},
    TallyCounter{"n_framing_errors", "characters received within the message with a bad stop bit",
                 &Tally::n_framing_errors},
    TallyCounter{"n_frames", "frames sent", &Tally::n_frames},
    TallyCounter{"n_frames_ok", "frames delivered intact", &Tally::n_frames_ok},
    TallyCounter{"n_frames_lost", "frames not delivered intact", &Tally::n_frames_lost},
    TallyCounter{"n_frames_undetected", "frames that passed the checksum but were wrong",
                 &Tally::n_frames_undetected},
    TallyCounter{"n_frames_false", "frames accepted though none was sent", &Tally::n_frames_false},
    TallyCounter{"n_frames_unheard", "frames lost: no character received",
                 &Tally::n_frames_unheard},
    TallyCounter{"n_frames_unended", "frames lost: characters received, but no line ended",
                 &Tally::n_frames_unended},
    TallyCounter{"n_rejected_unprintable", "lines rejected: unprintable character",
                 &Tally::n_rejected_unprintable},
    TallyCounter{"n_rejected_short", "lines rejected: too short", &Tally::n_rejected_short},
    TallyCounter{"n_rejected_not_hex", "lines rejected: checksum not hexadecimal",
                 &Tally::n_rejected_not_hex},
    TallyCounter{"n_rejected_checksum", "lines rejected: wrong checksum",
                 &Tally::n_rejected_checksum},
    TallyCounter{"n_rejected_overlong", "lines rejected: too long", &Tally::n_rejected_overlong},
    TallyCounter{"n_frames_bit_errors", "frames with a bit error", &Tally::n_frames_bit_errors},
    TallyCounter{"sum_bit_errors_squared", "sum over frames of squared bit errors",
                 &Tally::sum_bit_errors_squared},
    TallyCounter{"sum_bits_squared", "sum over frames of squared bits", &Tally::sum_bits_squared},
    TallyCounter{"sum_bit_errors_times_bits", "sum over frames of bit errors times bits",
                 &Tally::sum_bit_errors_times_bits}};

template <WeightedSum Weighted::*of, double WeightedSum::*part>
double& sum(Weighted& weighted) {
  return weighted.*of.*part;
}

constexpr auto bits = &Weighted::bit_errors;
constexpr auto frames = &Weighted::frames_lost;

constexpr std::array weights{
    WeightCounter{"n_groups", "groups of frames drawn together",
                  [](Weighted& w) -> double& { return w.n_groups; }},
    WeightCounter{"sum_weighted_bit_errors", "sum over runs of bit errors, weighted",
                  sum<bits, &WeightedSum::sum>},
    WeightCounter{"sum_weighted_bit_errors_squared", "sum over runs of their squares",
                  sum<bits, &WeightedSum::squares>},
    WeightCounter{"sum_group_bit_errors_squared", "sum over groups of the squared sum in each",
                  sum<bits, &WeightedSum::group_squares>},
    WeightCounter{"max_weighted_bit_errors", "the largest of the runs",
                  sum<bits, &WeightedSum::largest>},
    WeightCounter{"sum_weighted_frames_lost", "sum over runs of frames lost, weighted",
                  sum<frames, &WeightedSum::sum>},
    WeightCounter{"sum_weighted_frames_lost_squared", "sum over runs of their squares",
                  sum<frames, &WeightedSum::squares>},
    WeightCounter{"sum_group_frames_lost_squared", "sum over groups of the squared sum in each",
                  sum<frames, &WeightedSum::group_squares>},
    WeightCounter{"max_weighted_frames_lost", "the largest of the runs",
                  sum<frames, &WeightedSum::largest>},
    WeightCounter{"sum_dark_likelihood",
                  "sum over frames of about the probability of light in a dark bit",
                  [](Weighted& w) -> double& { return w.dark_likelihood; }}};

}  // namespace

std::span<const TallyCounter> tally_counters() { return counters; }

std::span<const WeightCounter> weight_counters() { return weights; }

}  // namespace sim
