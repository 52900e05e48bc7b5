#pragma once
// gnuplot, another's program, which makes PNG and PDF of drawings. It is asked for by --png and
// --pdf and by nothing else.
#include <optional>
#include <string>
#include <vector>

#include "sim/picture/gnuplot_script.hpp"

namespace sim {

/// Throws Failure(environment) where it is not installed, or was built without what draws them.
void require_gnuplot(PaperFormat format);

/// The bytes of a file that is_own_png() or is_own_pdf() knows, a PDF with a page a drawing;
/// nothing if a signal stopped it. Throws Failure(environment) where gnuplot fails.
std::optional<std::string> drawn_by_gnuplot(const std::vector<std::string>& drawings,
                                            PaperFormat format);

}  // namespace sim
