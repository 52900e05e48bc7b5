#include "sim/profile.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace sim {

Profile& Profile::operator+=(const Profile& other) {
  messages_s += other.messages_s;
  for (std::size_t i = 0; i < chain_s.size(); ++i) chain_s[i] += other.chain_s[i];
  decoding_s += other.decoding_s;
  return *this;
}

std::string profile_lines(const Profile& profile, std::uint64_t n_samples) {
  const std::vector<std::pair<const char*, double>> stages{
      {"messages", profile.messages_s},       {"noise", profile.chain_s[0]},
      {"light", profile.chain_s[1]},          {"light of others", profile.chain_s[2]},
      {"receiver", profile.chain_s[3]},       {"pin", profile.chain_s[4]},
      {"UART and frames", profile.decoding_s}};
  double total = 0;
  for (const auto& [name, seconds] : stages) total += seconds;
  if (total == 0) return "nothing was run, so there is no profile\n";
  std::string text = "time of the threads          s   share   ns a sample\n";
  const auto line = [&](const char* name, double seconds) {
    text += fmt::format("  {:<16}  {:>10.3f}  {:>5.1f}%  {:>12.4f}\n", name, seconds,
                        100 * seconds / total, 1e9 * seconds / static_cast<double>(n_samples));
  };
  for (const auto& [name, seconds] : stages) line(name, seconds);
  line("all", total);
  return text;
}

}  // namespace sim
