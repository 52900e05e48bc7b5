#pragma once
// The columns of an arena: of all devices together, of each device, and of each frame heard.
#include <cstdint>
#include <utility>

#include "sim/arena/arena_experiment.hpp"
#include "sim/columns/column.hpp"

namespace sim {

const Columns<ArenaPoint>& arena_columns();

/// The same without the marks that end a row, for experiments that hold an arena.
Columns<ArenaPoint> arena_variables();

/// Adds the headed columns of messages (sent, in reach, ... delivered) and of their loss, which is
/// the last and is given back. A row's tally is that of a device, or of several together.
template <class Row, class TallyOf>
Column<Row>& add_message_columns(Columns<Row>& columns, VariableFacts loss, TallyOf tally_of) {
  const auto count = [&](const TextColumn& heading, std::uint64_t (*read)(const SenderTally&),
                         int spared = 0) {
    columns.count({}, [=](const Row& row) { return read(tally_of(row)); })
        .headed(heading)
        .spared_before(spared);
  };
  count({{"", "messages", "sent"}, 9}, [](const SenderTally& t) { return t.sent(); });
  count(
      {{"", "", "in reach"}, 9}, [](const SenderTally& t) { return t.n_in_reach; }, 1);
  count(
      {{"", "", "overlapped"}, 10}, [](const SenderTally& t) { return t.n_overlapped; }, 1);
  count(
      {{"", "", "captured"}, 9}, [](const SenderTally& t) { return t.n_captured; }, 1);
  count({{"", "", "delivered"}, 9}, [](const SenderTally& t) { return t[LossCause::delivered]; });
  return columns.ratio(std::move(loss), [=](const Row& row) { return frame_loss(tally_of(row)); })
      .headed({{"", "frame loss ratio", "[interval]"}, -estimate_width});
}

}  // namespace sim
