// Paper as SVG. Text stays text (DejaVu Sans; Verdana runs nearly as wide), so that pages and PDF can be searched.
#include <fmt/format.h>

#include <cmath>

#include "render/dashes.h"
#include "render/paper/paper.h"

namespace render {
namespace {

std::string number(double v) {
  std::string text = fmt::format("{:.2f}", v);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;  // XML forbids the others
    }
  return out;
}

std::string hex(const Colour& c) {
  const auto part = [](double v) { return static_cast<int>(std::lround(255 * std::min(1.0, std::max(0.0, v)))); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(c.red), part(c.green), part(c.blue));
}

std::string points(const std::vector<Vec2>& line, bool backwards = false) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2& p = line[backwards ? line.size() - 1 - i : i];
    if (i > 0) text += ' ';
    text += number(p.x) + ',' + number(p.y);
  }
  return text;
}

std::string element(const Fill& fill) {
  std::string outline = points(fill.edge);
  if (!fill.lower.empty()) outline += ' ' + points(fill.lower, true);
  return "<polygon points=\"" + outline + "\" fill=\"" + hex(fill.colour) + "\"" +
         (fill.opacity < 1 ? " fill-opacity=\"" + number(fill.opacity) + "\"" : "") + "/>\n";
}

std::string element(const Path& path) {
  std::string dashes;
  for (double length : dash_pattern(path.stroke.line))
    dashes += (dashes.empty() ? "" : " ") + number(length * std::max(path.stroke.width, 1.0));
  return "<polyline points=\"" + points(path.points) + "\" fill=\"none\" stroke=\"" + hex(path.stroke.colour) +
         "\" stroke-width=\"" + number(path.stroke.width) + "\" stroke-linejoin=\"round\"" +
         (dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"") + "/>\n";
}

std::string element(const Run& run) {
  const TextStyle& style = run.style;
  std::string text = "<text x=\"" + number(run.at.x) + "\" y=\"" + number(run.at.y) + "\" font-size=\"" +
                     number(style.size) + "\" fill=\"" + hex(style.colour) + "\"";
  if (style.anchor == Anchor::middle) text += " text-anchor=\"middle\"";
  if (style.anchor == Anchor::end) text += " text-anchor=\"end\"";
  if (style.bold) text += " font-weight=\"bold\"";
  if (style.upward) text += " transform=\"rotate(-90 " + number(run.at.x) + " " + number(run.at.y) + ")\"";
  return text + " xml:space=\"preserve\">" + escaped(run.text) + "</text>\n";
}

}  // namespace

std::string to_svg(const Paper& paper, const Provenance& facts) {
  std::string title, description, metadata;
  for (const auto& [key, value] : facts) {
    if (key == "Title")
      title = value;
    else if (key == "Description")
      description = value;
    else
      metadata += "<fact name=\"" + escaped(key) + "\">" + escaped(value) + "</fact>\n";
  }
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" "
      "height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\">\n",
      paper.width(), paper.height());
  out += "<title>" + escaped(title) + "</title>\n<desc>" + escaped(description) + "</desc>\n";
  if (!metadata.empty())
    out += "<metadata>\n<facts xmlns=\"urn:dem-report:facts\">\n" + metadata + "</facts>\n</metadata>\n";
  out += "<g font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n";
  for (const auto& item : paper.items()) out += std::visit([](const auto& it) { return element(it); }, item);
  return out + "</g>\n</svg>\n";
}

}  // namespace render
