#include "sim/threads/profile.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace sim {

Profile& Profile::operator+=(const Profile& other) {
  messages_s += other.messages_s;
  for (std::size_t i = 0; i < chain_s.size(); ++i) chain_s[i] += other.chain_s[i];
  envelope_s += other.envelope_s;
  decisions_s += other.decisions_s;
  decoding_s += other.decoding_s;
  return *this;
}

namespace {

using Stages = std::vector<std::pair<const char*, double>>;

/// The stages in their order; of those between LED and pin the ones that were run.
Stages stages_of(const Profile& profile, bool has_samples) {
  Stages stages{{"messages", profile.messages_s}};
  if (has_samples) {
    const char* names[channel::chain_stages] = {"noise", "light", "light of others", "receiver",
                                                "pin"};
    for (std::size_t i = 0; i < profile.chain_s.size(); ++i)
      stages.emplace_back(names[i], profile.chain_s[i]);
  }
  if (profile.envelope_s > 0) stages.emplace_back("envelope", profile.envelope_s);
  if (profile.decisions_s > 0) stages.emplace_back("decisions", profile.decisions_s);
  stages.emplace_back("UART and frames", profile.decoding_s);
  return stages;
}

/// What time is told for besides: "ns a sample".
struct Each {
  const char* heading;
  double per_second;
  std::uint64_t n;
};

std::string lines(const Stages& stages, const Each& each) {
  double total = 0;
  for (const auto& [name, seconds] : stages) total += seconds;
  if (total == 0) return "nothing was run, so there is no profile\n";
  std::string text = fmt::format("time of the threads          s   share   {:>11}\n", each.heading);
  const auto line = [&](const char* name, double seconds) {
    const double time = each.per_second * seconds / static_cast<double>(each.n);
    text += fmt::format("  {:<16}  {:>10.3f}  {:>5.1f}%  {:>12}\n", name, seconds,
                        100 * seconds / total, each.n > 0 ? fmt::format("{:.4f}", time) : "-");
  };
  for (const auto& [name, seconds] : stages) line(name, seconds);
  line("all", total);
  return text;
}

}  // namespace

std::string profile_lines(const Profile& profile, std::uint64_t n_samples) {
  return lines(stages_of(profile, n_samples > 0), {"ns a sample", 1e9, n_samples});
}

std::string profile_lines(const RunProfile& profile) {
  return lines({{"preparing", profile.preparing_s},
                {"runs", profile.running_s},
                {"describing", profile.describing_s},
                {"writing", profile.writing_s}},
               {"ms a run", 1e3, profile.n_runs});
}

}  // namespace sim
