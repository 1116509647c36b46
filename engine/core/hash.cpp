#include "engine/core/hash.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "engine/core/errors.h"

namespace dem {

std::string sha256(std::string_view text) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw EnvironmentError("OpenSSL does not give SHA-256 on this machine");
  }
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace dem
