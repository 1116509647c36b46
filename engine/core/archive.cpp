#include "engine/core/archive.h"

#include <array>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"

namespace dem {
namespace {

constexpr std::string_view magic = "dem-report checkpoint 1\n";
constexpr std::size_t hash_size = 64;
constexpr std::size_t head_size = magic.size() + hash_size + 2 * sizeof(std::uint64_t);

// A word at a time, so that a state of 100 MB costs a few hundredths of a second (murmur's finaliser as the mixer).
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 0x9e3779b97f4a7c15ULL ^ bytes.size();
  const auto mix = [&sum](std::uint64_t word) {
    sum = (sum ^ word) * 0xff51afd7ed558ccdULL;
    sum ^= sum >> 33;
  };
  while (bytes.size() >= sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    mix(word);
    bytes.remove_prefix(sizeof word);
  }
  for (const char byte : bytes) mix(static_cast<unsigned char>(byte));
  return sum;
}

}  // namespace

void ArchiveWriter::items(const void* data, std::size_t count, std::size_t size) {
  const std::array<std::uint64_t, 2> head = {size, count};
  bytes_.append(reinterpret_cast<const char*>(head.data()), sizeof head);
  if (count * size > 0) bytes_.append(static_cast<const char*>(data), count * size);
}

std::size_t ArchiveReader::head(std::size_t size) {
  std::array<std::uint64_t, 2> head{};
  copy(head.data(), sizeof head);
  if (head[0] != size) throw ArchiveMismatch("it was written by another version of the program");
  // An element takes at least its size, a nested one at least its own head: no count beyond what is left is true.
  const std::uint64_t least = size > 0 ? size : 1;
  if (head[1] > bytes_.size() / least) throw ArchiveMismatch("it ends too early");
  return head[1];
}

void ArchiveReader::copy(void* to, std::size_t size) {
  if (size > bytes_.size()) throw ArchiveMismatch("it ends too early");
  if (size > 0) std::memcpy(to, bytes_.data(), size);
  bytes_.remove_prefix(size);
}

void write_checkpoint(const std::filesystem::path& path, std::string_view content, std::string_view bytes) {
  std::string file;
  file.reserve(head_size + bytes.size());
  file += magic;
  file += sha256(content);
  const std::array<std::uint64_t, 2> tail = {bytes.size(), checksum(bytes)};
  file.append(reinterpret_cast<const char*>(tail.data()), sizeof tail);
  file += bytes;
  write_file(path, file);
}

CheckpointLoad read_checkpoint(const std::filesystem::path& path, std::string_view content, std::string& bytes) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const auto unused = [&](const std::string& why) {
    return CheckpointLoad{false, "checkpoint " + path.string() + " is not used: " + why};
  };
  std::string file;
  try {
    file = read_file(path);
  } catch (const EnvironmentError& failure) {
    return unused(failure.what());
  }
  const std::string_view view = file;
  if (!view.starts_with(magic) || view.size() < head_size) return unused("it is damaged");
  if (view.substr(magic.size(), hash_size) != sha256(content)) return unused("it belongs to another input");
  std::array<std::uint64_t, 2> head{};
  std::memcpy(head.data(), view.data() + magic.size() + hash_size, sizeof head);
  const std::string_view body = view.substr(head_size);
  if (body.size() != head[0] || checksum(body) != head[1]) return unused("it is damaged");
  bytes = body;
  return {true, {}};
}

}  // namespace dem
