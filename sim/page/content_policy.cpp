#include "sim/page/content_policy.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

namespace sim {
namespace {

std::string sha256_in_base64(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr);
  std::array<unsigned char, 2 * EVP_MAX_MD_SIZE> letters{};
  const int n = EVP_EncodeBlock(letters.data(), digest.data(), static_cast<int>(size));
  return {letters.begin(), letters.begin() + n};
}

}  // namespace

std::string content_policy(const std::vector<std::string>& scripts) {
  std::string known;
  for (const std::string& script : scripts)
    known += fmt::format(" 'sha256-{}'", sha256_in_base64(script));
  return fmt::format(
      "default-src 'none'; script-src{}; style-src 'unsafe-inline'; base-uri 'none'; "
      "form-action 'none'",
      known);
}

}  // namespace sim
