#include "reports/page/abbreviations.h"

#include <array>

namespace reports {
namespace {

constexpr std::array known{
    Abbreviation{"AR", "aspect ratio of the grains"},
    Abbreviation{"UCS", "uniaxial compressive strength"},
    Abbreviation{"TS", "tensile strength"},
    Abbreviation{"σci", "crack initiation stress"},
    Abbreviation{"σ_ci", "crack initiation stress"},
    Abbreviation{"σcd", "crack damage stress"},
    Abbreviation{"σ_cd", "crack damage stress"},
    Abbreviation{"σ₃", "confining pressure"},
    Abbreviation{"σₙ", "normal stress"},
    Abbreviation{"K_Ic", "fracture toughness in opening mode"},
    Abbreviation{"a/W", "depth of the notch over that of the bar"},
    Abbreviation{"IQR", "interquartile range"},
};

// Letters, digits and all that is not ASCII go on a word.
bool in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]))) return true;
  }
  return false;
}

}  // namespace

std::vector<Abbreviation> abbreviations_in(std::string_view text) {
  std::vector<Abbreviation> found;
  for (const Abbreviation& one : known) {
    const bool said = !found.empty() && found.back().meaning == one.meaning;  // with an index or without
    if (!said && has_word(text, one.symbol)) found.push_back(one);
  }
  return found;
}

}  // namespace reports
