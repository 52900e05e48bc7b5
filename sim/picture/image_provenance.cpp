#include "sim/picture/image_provenance.hpp"

#include <boost/crc.hpp>
#include <string_view>

#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view png_begins = "\x89PNG\r\n\x1a\n";
constexpr std::size_t png_head = png_begins.size() + 25;  // with the chunk IHDR

constexpr std::string_view pdf_begins = "%PDF-", pdf_ends = "\nstartxref\n";
constexpr std::string_view pdf_mark = "\n% by cosys-sim";
constexpr std::size_t pdf_tail = 64;  // mark, offset of ten digits, %%EOF

/// The most significant first, as PNG has its numbers.
std::string four_bytes(std::uint32_t number) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes += static_cast<char>(number >> shift & 0xffU);
  return bytes;
}

/// PNG (Third Edition), 11.3.3.2.
const std::string& png_mark() {
  static const std::string mark = [] {
    constexpr std::string_view text = "tEXtSoftware\0cosys-sim"sv;
    boost::crc_32_type sum;
    sum.process_bytes(text.data(), text.size());
    return four_bytes(text.size() - 4) + std::string(text) + four_bytes(sum.checksum());
  }();
  return mark;
}

}  // namespace

std::optional<std::string> marked_as_own(std::string bytes, PaperFormat format) {
  const bool is_png = format == PaperFormat::png;
  if (!bytes.starts_with(is_png ? png_begins : pdf_begins)) return std::nullopt;
  const std::size_t place = is_png ? png_head : bytes.rfind(pdf_ends);
  if (place >= bytes.size()) return std::nullopt;
  return bytes.insert(place, is_png ? png_mark() : pdf_mark);
}

bool is_own_png(const std::filesystem::path& path) {
  const std::string head = beginning_of(path, png_head + png_mark().size());
  return head.starts_with(png_begins) && head.ends_with(png_mark());
}

bool is_own_pdf(const std::filesystem::path& path) {
  return beginning_of(path, pdf_begins.size()) == pdf_begins &&
         end_of(path, pdf_tail).find(pdf_mark) != std::string::npos;
}

}  // namespace sim
