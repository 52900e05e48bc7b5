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

}  // namespace

std::string profile_lines(const Profile& profile, std::uint64_t n_samples) {
  const Stages stages = stages_of(profile, n_samples > 0);
  double total = 0;
  for (const auto& [name, seconds] : stages) total += seconds;
  if (total == 0) return "nothing was run, so there is no profile\n";
  std::string text = "time of the threads          s   share   ns a sample\n";
  const auto line = [&](const char* name, double seconds) {
    const double ns = 1e9 * seconds / static_cast<double>(n_samples);
    text += fmt::format("  {:<16}  {:>10.3f}  {:>5.1f}%  {:>12}\n", name, seconds,
                        100 * seconds / total, n_samples > 0 ? fmt::format("{:.4f}", ns) : "-");
  };
  for (const auto& [name, seconds] : stages) line(name, seconds);
  line("all", total);
  return text;
}

}  // namespace sim
