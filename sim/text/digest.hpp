#pragma once
#include <string>

namespace sim {

/// Hash of bytes as 32 hex digits (XXH3, 128 bits).
std::string digest_of(const std::string& bytes);

}  // namespace sim
