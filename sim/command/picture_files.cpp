#include "sim/command/picture_files.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "sim/command/gnuplot.hpp"
#include "sim/failure.hpp"
#include "sim/page/paper.hpp"
#include "sim/picture/image_provenance.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

struct PictureKind {
  std::optional<fs::path> PictureFolders::*folder;
  const char* ending;
  bool (*is_own)(const fs::path&);
  std::optional<PaperFormat> drawn_as;  // by gnuplot; an SVG is there already
};

const std::array kinds{PictureKind{&PictureFolders::svg, ".svg", is_drawing, std::nullopt},
                       PictureKind{&PictureFolders::png, ".png", is_own_png, PaperFormat::png},
                       PictureKind{&PictureFolders::pdf, ".pdf", is_own_pdf, PaperFormat::pdf}};

using PlacedPictures = std::map<fs::path, const PagePicture*>;

/// Whether the report for print is asked for, not a folder.
bool is_paper(const PictureKind& kind, const fs::path& place) {
  return kind.drawn_as == PaperFormat::pdf && place.extension() == ".pdf" &&
         !fs::is_directory(place);
}

const PagePicture* picture_in(const PageSection& section) {
  if (section.trial) return &section.trial->still;
  return section.picture ? &*section.picture : nullptr;
}

/// The files that pictures become: bit-errors.svg, bit-errors-2.svg...
PlacedPictures places_of(const Page& page, const fs::path& folder, const char* ending) {
  PlacedPictures places;
  for (const PageSection& section : page.sections) {
    const PagePicture* picture = picture_in(section);
    if (picture == nullptr) continue;
    fs::path place = folder / (picture->name + ending);
    for (int i = 2; places.contains(place); ++i)
      place = folder / fmt::format("{}-{}{}", picture->name, i, ending);
    places[place] = picture;
  }
  return places;
}

std::optional<std::string> drawn(const PagePicture& picture, const PictureKind& kind) {
  return kind.drawn_as ? drawn_by_gnuplot({picture.svg}, *kind.drawn_as)
                       : always_light(picture.svg);
}

}  // namespace

void require_tools(const PictureFolders& folders) {
  for (const PictureKind& kind : kinds)
    if (folders.*kind.folder && kind.drawn_as) require_gnuplot(*kind.drawn_as);
}

std::optional<std::vector<PictureFile>> picture_files(const Page& page,
                                                      const PictureFolders& folders) {
  std::vector<PictureFile> files;
  for (const PictureKind& kind : kinds) {
    if (!(folders.*kind.folder)) continue;
    const fs::path& folder = *(folders.*kind.folder);
    if (is_paper(kind, folder)) {
      refuse_to_lose(folder, {kind.is_own, "a PDF of cosys-sim"});
      std::optional<std::string> bytes = drawn_by_gnuplot(paper_pages(page), PaperFormat::pdf);
      if (!bytes) return std::nullopt;
      files.push_back({folder, std::move(*bytes)});
      continue;
    }
    const PlacedPictures places = places_of(page, folder, kind.ending);
    for (const auto& [place, picture] : places)
      refuse_to_lose(place, {kind.is_own, "a picture of cosys-sim"});
    for (const auto& [place, picture] : places) {
      std::optional<std::string> bytes = drawn(*picture, kind);
      if (!bytes) return std::nullopt;
      files.push_back({place, std::move(*bytes)});
    }
  }
  return files;
}

void make_folders(const PictureFolders& folders) {
  for (const PictureKind& kind : kinds) {
    if (!(folders.*kind.folder) || is_paper(kind, *(folders.*kind.folder))) continue;
    const fs::path& folder = *(folders.*kind.folder);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw Failure(ExitCode::environment,
                    fmt::format("cannot create the folder {} ({}) choose another place",
                                folder.string(), error.message()));
  }
}

}  // namespace sim
