#include "engine/core/base64.h"

#include <openssl/evp.h>

#include <algorithm>

namespace dem {

std::string base64(std::string_view bytes) {
  constexpr std::size_t part = 3 << 28;  // OpenSSL counts in int; whole groups of three are encoded on their own
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  // The zero that EVP_EncodeBlock puts behind the last digit falls on the string's own.
  for (std::size_t at = 0; at < bytes.size(); at += part) {
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()) + at / 3 * 4,
                    reinterpret_cast<const unsigned char*>(bytes.data()) + at,
                    static_cast<int>(std::min(part, bytes.size() - at)));
  }
  return text;
}

}  // namespace dem
