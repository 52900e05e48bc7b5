#pragma once
#include <cstdint>
#include <string>

namespace sim {

/// Hash of bytes as 32 hex digits (XXH3, 128 bits).
std::string digest_of(const std::string& bytes);

/// The same as a number (XXH3, 64 bits).
std::uint64_t hash_of(const std::string& bytes);

}  // namespace sim
