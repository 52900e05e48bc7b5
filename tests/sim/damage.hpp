#pragma once
// Damage to the bytes of an HDF5 file: bits, ranges and ends, and numbers of its structure (sizes,
// counts, addresses). Each damage has a number, and is the same whenever the file is.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace sim::test {

class Damage {
 public:
  explicit Damage(std::string whole) : whole_(std::move(whole)) {
    find_references();
    for (const char* signature : {"TREE", "SNOD", "HEAP", "GCOL", "OHDR", "FRHP", "BTHD", "FSHD"})
      find_signature(signature);
  }

  /// The file with the damage of this number.
  std::string damaged(std::uint64_t number) const {
    Random random(number);
    std::string bytes = whole_;
    switch (random() % 8) {
      case 0:
        flip_bits(random, bytes);
        break;
      case 1:
        overwrite(random, bytes);
        break;
      case 2:
        fill(random, bytes);
        break;
      case 3:
        bytes.resize(random() % bytes.size());
        break;
      default:
        bend_structure(random, bytes);
    }
    return bytes;
  }

 private:
  using Random = std::mt19937_64;
  static constexpr std::size_t word = sizeof(std::uint64_t);

  struct Range {
    std::size_t begin, size;
  };

  std::uint64_t number_at(std::size_t place) const {
    std::uint64_t number = 0;
    std::memcpy(&number, whole_.data() + place, word);
    return number;
  }

  /// Words that may be an address in the file, a size or a count.
  void find_references() {
    for (std::size_t place = 0; place + word <= whole_.size(); place += word)
      if (number_at(place) > 0 && number_at(place) < whole_.size()) references_.push_back(place);
  }

  void find_signature(std::string_view signature) {
    for (auto at = whole_.find(signature); at != std::string::npos;
         at = whole_.find(signature, at + 1))
      structures_.push_back(at);
  }

  static void flip_bits(Random& random, std::string& bytes) {
    for (auto n = 1 + random() % 60; n > 0; --n) {
      char& byte = bytes[random() % bytes.size()];
      byte = static_cast<char>(byte ^ (1 << random() % 8));
    }
  }

  static Range range_in(Random& random, const std::string& bytes) {
    const std::size_t begin = random() % bytes.size(), most = std::size_t{1} << (random() % 13);
    return {begin, std::min<std::size_t>(bytes.size() - begin, 1 + random() % most)};
  }

  static void overwrite(Random& random, std::string& bytes) {
    const Range range = range_in(random, bytes);
    for (std::size_t i = 0; i < range.size; ++i)
      bytes[range.begin + i] = static_cast<char>(random());
  }

  static void fill(Random& random, std::string& bytes) {
    const Range range = range_in(random, bytes);
    bytes.replace(range.begin, range.size, range.size, random() % 4 == 0 ? '\xff' : '\0');
  }

  /// One to three numbers of the structure get others.
  void bend_structure(Random& random, std::string& bytes) const {
    constexpr std::array<std::size_t, 6> widths{1, 2, 4, 8, 8, 8};
    for (auto n = 1 + random() % 3; n > 0; --n) {
      const std::size_t place = place_of_number(random);
      const std::uint64_t number = other_number(random, place);
      const std::size_t width = widths.at(random() % widths.size());
      if (place + word <= bytes.size()) std::memcpy(bytes.data() + place, &number, width);
    }
  }

  std::size_t place_of_number(Random& random) const {
    constexpr std::size_t head_bytes = 64;  // behind a signature
    switch (random() % 4) {
      case 0:
        if (!structures_.empty())
          return structures_[random() % structures_.size()] + random() % head_bytes;
        [[fallthrough]];
      case 1:
        return random() % whole_.size();
      default:
        return references_[random() % references_.size()];
    }
  }

  std::uint64_t other_number(Random& random, std::size_t place) const {
    const std::uint64_t before = place + word <= whole_.size() ? number_at(place) : 0;
    const std::uint64_t another = number_at(references_[random() % references_.size()]);
    const std::array<std::uint64_t, 13> others{0,
                                               1,
                                               ~std::uint64_t{0},
                                               ~std::uint64_t{0} - 15,
                                               std::uint64_t{1} << 60U,
                                               std::uint64_t{1} << 31U,
                                               whole_.size(),
                                               before + 1,
                                               before - 1,
                                               before * 2,
                                               before ^ (std::uint64_t{1} << random() % 64),
                                               another,
                                               another};
    return others.at(random() % others.size());
  }

  std::string whole_;
  std::vector<std::size_t> references_, structures_;
};

}  // namespace sim::test
