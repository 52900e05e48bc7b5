#pragma once
// Tallies as bytes, by cereal, for checkpoints and for the members of an MPI job.
#include <bit>
#include <cereal/cereal.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace sim {

/// Writes numbers as the processor has them, least byte first; others are refused when they are
/// read.
class CheckpointOutput
    : public cereal::OutputArchive<CheckpointOutput, cereal::AllowEmptyClassElision> {
 public:
  CheckpointOutput() : OutputArchive(this) {
    const std::uint8_t is_little_endian = std::endian::native == std::endian::little ? 1 : 0;
    save(&is_little_endian, sizeof is_little_endian);
  }

  void save(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them. A list has no more elements than bytes are left, so a damaged one asks for at most
/// some hundred times the file.
/// Throws cereal::Exception.
class CheckpointInput
    : public cereal::InputArchive<CheckpointInput, cereal::AllowEmptyClassElision> {
 public:
  explicit CheckpointInput(std::string_view bytes) : InputArchive(this), left_(bytes) {
    std::uint8_t is_little_endian = 0;
    load(&is_little_endian, sizeof is_little_endian);
    if ((is_little_endian != 0) != (std::endian::native == std::endian::little))
      throw cereal::Exception("another order of bytes");
  }

  void load(void* to, std::size_t size) {
    if (size > left_.size()) throw cereal::Exception("the bytes end too soon");
    if (size == 0) return;
    std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }

  std::size_t left() const { return left_.size(); }

 private:
  std::string_view left_;
};

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_SAVE_FUNCTION_NAME(CheckpointOutput& archive, const T& number) {
  archive.save(&number, sizeof number);
}
template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(CheckpointInput& archive, T& number) {
  if constexpr (std::is_same_v<T, bool>) {
    std::uint8_t byte = 0;
    archive.load(&byte, sizeof byte);
    if (byte > 1) throw cereal::Exception("no truth value");
    number = byte == 1;
  } else {
    archive.load(&number, sizeof number);
  }
}

template <class T>
void CEREAL_SAVE_FUNCTION_NAME(CheckpointOutput& archive, const cereal::BinaryData<T>& data) {
  archive.save(data.data, static_cast<std::size_t>(data.size));
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(CheckpointInput& archive, cereal::BinaryData<T>& data) {
  archive.load(data.data, static_cast<std::size_t>(data.size));
}

template <class T>
void CEREAL_SAVE_FUNCTION_NAME(CheckpointOutput& archive, const cereal::SizeTag<T>& tag) {
  archive(tag.size);
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(CheckpointInput& archive, cereal::SizeTag<T>& tag) {
  archive(tag.size);
  if (tag.size > archive.left()) throw cereal::Exception("a list is longer than the bytes");
}

template <class T>
std::string bytes_of(const T& value) {
  CheckpointOutput archive;
  archive(value);
  return archive.take();
}

template <class T>
T from_bytes(const std::string& bytes) {
  CheckpointInput archive(bytes);
  T value{};
  archive(value);
  if (archive.left() != 0) throw cereal::Exception("there are more bytes");
  return value;
}

}  // namespace sim

CEREAL_SETUP_ARCHIVE_TRAITS(sim::CheckpointInput, sim::CheckpointOutput)
