#pragma once
// CSV captures: columns of 0 and 1 are wires, others are analogue channels; a column that is the
// time, by its name ("Time [s]", time_s) or as the first that rises, gives the instants. Logic rows
// may be changes alone; analogue ones are evenly spaced. Without a time the sample rate is that of
// the head (csv_head.hpp), or is to be said. Where time begins below 0, as behind an oscilloscope's
// trigger, or with a date, instants are told from the first row.
#include <string>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// Fills in `logic` or `samples`, as the column is that is read, and which one that is.
void open_csv(const std::string& file, const CaptureSettings& settings, Capture& capture);

}  // namespace sim
