#pragma once
// A drawing for gnuplot (5.4 or later, cairo's terminals), to be had as PNG and PDF: it looks as a
// browser shows the SVG on light paper, texts before all else.
#include <string>
#include <vector>

namespace sim {

enum class PaperFormat { png, pdf };

/// Of gnuplot: "pngcairo".
const char* terminal_name(PaperFormat format);

/// Makes gnuplot write the picture to its stdout: PNG with two pixels for each of the drawing's,
/// PDF with 96 of them to an inch. `drawings` are what SvgDrawing made, the pages of a PDF, all as
/// large as the first; their texts are shown, never obeyed.
std::string gnuplot_script(const std::vector<std::string>& drawings, PaperFormat format);

}  // namespace sim
