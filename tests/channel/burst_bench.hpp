#pragma once
// The bench is a part of the program: `cosys-sim parts` measures with it too.
#include "channel/data_sheet_bench.hpp"
