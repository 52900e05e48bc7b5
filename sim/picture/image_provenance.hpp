#pragma once
// PNG and PDF files that say that this program made them, in places where others pass it over: a
// chunk "Software" behind a PNG's head, a comment before a PDF's last lines.
#include <filesystem>
#include <optional>
#include <string>

#include "sim/picture/gnuplot_script.hpp"

namespace sim {

/// Nothing if `bytes` are no such file.
std::optional<std::string> marked_as_own(std::string bytes, PaperFormat format);

/// Whether a file is so marked.
bool is_own_png(const std::filesystem::path& path);
bool is_own_pdf(const std::filesystem::path& path);

}  // namespace sim
