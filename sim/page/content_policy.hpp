#pragma once
// What a browser may do with a page: run its own scripts and nothing else, and load nothing.
// Whatever a text of a result turns out to be, no browser executes it.
#include <string>
#include <vector>

namespace sim {

/// As of W3C's Content Security Policy Level 3, for a meta element. `scripts`: the texts of the
/// script elements of the page, byte for byte; each is known by its SHA-256.
std::string content_policy(const std::vector<std::string>& scripts);

}  // namespace sim
