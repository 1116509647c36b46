#include "render/paper/text.h"

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "engine/core/errors.h"
#include "render/paper/paper.h"

namespace render {
namespace {

std::string find_font(const char* name) {
  for (const char* folder : {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu-sans-fonts/",
                             "/usr/share/fonts/TTF/", "/usr/share/fonts/dejavu/"}) {
    const std::string path = std::string(folder) + name;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) return path;
  }
  throw dem::EnvironmentError(std::string("the font ") + name + " is not installed; charts need the package " +
                              "fonts-dejavu-core");
}

int box_width(const std::string& text, int size, bool bold) {
  vtkNew<vtkTextProperty> property;
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile(font_file(bold).c_str());
  property->SetFontSize(size);
  int box[4] = {0, 0, 0, 0};
  constexpr int points_are_pixels = 72;
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr ||
      !renderer->GetBoundingBox(property.Get(), vtkStdString(text), box, points_are_pixels, vtkTextRenderer::FreeType))
    throw dem::EnvironmentError("cannot measure text with " + font_file(bold));
  return box[1] - box[0] + 1;
}

}  // namespace

const std::string& font_file(bool bold) {
  static const std::string regular = find_font("DejaVuSans.ttf");
  static const std::string heavy = find_font("DejaVuSans-Bold.ttf");
  return bold ? heavy : regular;
}

// Measured between two bars, so that blanks and bearings at the ends count.
double run_width(const std::string& text, double size, bool bold) {
  constexpr int measured = 200;
  if (text.empty()) return 0;
  // Measuring draws: the same few words are asked for over and over while a chart is laid out.
  static std::map<std::pair<std::string, bool>, int> known;
  auto entry = known.find({text, bold});
  if (entry == known.end()) {
    const int width = box_width("|" + text + "|", measured, bold) - box_width("||", measured, bold);
    entry = known.insert({{text, bold}, width}).first;
  }
  return entry->second * size / measured;
}

namespace {

constexpr double index_scale = 0.72, lower_shift = -0.18, raised_shift = 0.36;

/// A character that Unicode has as an index or exponent: what it is in full size, and where it goes.
struct SmallForm {
  std::string_view form, full;
  double shift;
};
constexpr SmallForm small_forms[] = {
    {"₀", "0", lower_shift},  {"₁", "1", lower_shift},  {"₂", "2", lower_shift},  {"₃", "3", lower_shift},
    {"₄", "4", lower_shift},  {"ₙ", "n", lower_shift},  {"ₛ", "s", lower_shift},  {"ₚ", "p", lower_shift},
    {"ᵤ", "u", lower_shift},  {"ᵢ", "i", lower_shift},  {"ₘ", "m", lower_shift},  {"⁰", "0", raised_shift},
    {"¹", "1", raised_shift}, {"²", "2", raised_shift}, {"³", "3", raised_shift}, {"⁴", "4", raised_shift},
    {"⁵", "5", raised_shift}, {"⁶", "6", raised_shift}, {"⁷", "7", raised_shift}, {"⁸", "8", raised_shift},
    {"⁹", "9", raised_shift}, {"⁻", "−", raised_shift}};

}  // namespace

std::vector<Piece> pieces_of(const std::string& text) {
  std::vector<Piece> pieces;
  std::string plain;
  const auto flush = [&] {
    if (!plain.empty()) pieces.push_back({plain, 1, 0});
    plain.clear();
  };
  const auto add_small = [&](const SmallForm& small) {
    flush();
    if (!pieces.empty() && pieces.back().shift == small.shift)
      pieces.back().text += small.full;
    else
      pieces.push_back({std::string(small.full), index_scale, small.shift});
  };
  for (std::size_t i = 0; i < text.size();) {
    const auto* small = std::find_if(std::begin(small_forms), std::end(small_forms), [&](const SmallForm& one) {
      return text.compare(i, one.form.size(), one.form) == 0;
    });
    if (small != std::end(small_forms)) {
      add_small(*small);
      i += small->form.size();
      continue;
    }
    const bool lower = text.compare(i, 2, "_{") == 0, higher = text.compare(i, 2, "^{") == 0;
    const std::size_t end = lower || higher ? text.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      plain += text[i++];
      continue;
    }
    flush();
    pieces.push_back({text.substr(i + 2, end - i - 2), index_scale, lower ? lower_shift : raised_shift});
    i = end + 1;
  }
  flush();
  if (pieces.empty()) pieces.push_back({"", 1, 0});
  return pieces;
}

double text_width(const std::string& text, double size, bool bold) {
  double width = 0;
  for (const Piece& piece : pieces_of(text)) width += run_width(piece.text, size * piece.scale, bold);
  return width;
}

}  // namespace render
