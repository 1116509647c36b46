#include "engine/core/text.h"

#include <array>
#include <cstdio>

namespace dem {

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const Character broken{first, 1, false};
  if (first < 0x80) return {first, 1, true};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return broken;
  char32_t code = first & (0xffU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return broken;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return broken;
  return {code, bytes, true};
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Character next = first_character(text);
    if (!next.valid) return false;
    text.remove_prefix(next.bytes);
  }
  return true;
}

std::size_t length_of(std::string_view text) {
  std::size_t length = 0;
  for (; !text.empty(); ++length) text.remove_prefix(first_character(text).bytes);
  return length;
}

bool is_control(char32_t code) {
  const auto from_to = [code](char32_t low, char32_t high) { return code >= low && code <= high; };
  return code < 0x20 || from_to(0x7f, 0x9f) || code == 0xad || code == 0x61c || code == 0x180e ||
         from_to(0x200b, 0x200f) || from_to(0x2028, 0x202e) || from_to(0x2060, 0x206f) || code == 0xfeff ||
         from_to(0xfff9, 0xfffb) || from_to(0xe0000, 0xe007f);
}

bool is_letter_or_digit(char32_t code) {
  const auto from_to = [code](char32_t low, char32_t high) { return code >= low && code <= high; };
  if (code < 0x80) return from_to('0', '9') || from_to('A', 'Z') || from_to('a', 'z');
  if (is_control(code) || code == 0xd7 || code == 0xf7) return false;
  return from_to(0xc0, 0x1fff) || from_to(0x3041, 0xd7a3);
}

std::string printable(std::string_view text, bool lines) {
  std::string shown;
  while (!text.empty()) {
    const Character next = first_character(text);
    if (next.valid && (!is_control(next.code) || (lines && next.code == '\n'))) {
      shown += text.substr(0, next.bytes);
    } else {
      std::array<char, 12> escape{};
      const bool byte = !next.valid || next.code < 0x80;
      std::snprintf(escape.data(), escape.size(), byte ? "\\x%02x" : "\\u%04x", static_cast<unsigned>(next.code));
      shown += escape.data();
    }
    text.remove_prefix(next.bytes);
  }
  return shown;
}

}  // namespace dem
