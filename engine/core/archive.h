#pragma once
// Checkpoints: the state of a running case as one binary file, for the machine that wrote it.
//
// A state lists its members once, for writing and for reading:
//
//   struct State {
//     std::int64_t step = 0;
//     std::vector<double> position;
//     std::vector<Crack> cracks;                       // trivially copyable structures go as they are
//     template <class Archive> void archive(Archive& a) { a(step, position, cracks); }
//   };
//   save_checkpoint(context.checkpoint, spec.content, state);
//   const CheckpointLoad load = load_checkpoint(context.checkpoint, spec.content, state);
//
// File: magic, SHA-256 of the content key, size and checksum of what follows, then the members in order, each with its
// element size and count. A checkpoint that is damaged, of another case, another input or another layout is not used.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dem {

namespace archive_detail {

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};

template <class T, class Archive>
concept Composite = requires(T& value, Archive& archive) {
  value.archive(archive);
};

/// Written and read as their bytes. Pointers and views would point nowhere in another process.
template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, std::string_view>;

}  // namespace archive_detail

/// Collects values as bytes.
class ArchiveWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  void put(const T& value) {
    using archive_detail::is_vector;
    if constexpr (std::is_same_v<T, std::string>) {
      items(value.data(), value.size(), 1);
    } else if constexpr (is_vector<T>::value) {
      using Item = typename T::value_type;
      static_assert(!std::is_same_v<Item, bool>, "use std::vector<std::uint8_t>");
      if constexpr (archive_detail::Plain<Item> && !archive_detail::Composite<Item, ArchiveWriter>) {
        items(value.data(), value.size(), sizeof(Item));
      } else {
        items(nullptr, value.size(), 0);
        for (const Item& item : value) put(item);
      }
    } else if constexpr (archive_detail::Composite<T, ArchiveWriter>) {
      const_cast<T&>(value).archive(*this);  // one archive() serves both directions; writing changes nothing
    } else {
      static_assert(archive_detail::Plain<T>, "give the type an archive() member");
      items(&value, 1, sizeof(T));
    }
  }
  void items(const void* data, std::size_t count, std::size_t size);
  std::string bytes_;
};

/// Thrown when the bytes do not hold what is asked for; load_checkpoint() turns it into a note.
struct ArchiveMismatch : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Gives the values back in the order of writing.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  template <class T>
  void get(T& value) {
    using archive_detail::is_vector;
    if constexpr (std::is_same_v<T, std::string>) {
      value.resize(head(1));
      copy(value.data(), value.size());
    } else if constexpr (is_vector<T>::value) {
      using Item = typename T::value_type;
      if constexpr (archive_detail::Plain<Item> && !archive_detail::Composite<Item, ArchiveReader>) {
        value.resize(head(sizeof(Item)));
        copy(value.data(), value.size() * sizeof(Item));
      } else {
        value.clear();
        value.resize(head(0));
        for (Item& item : value) get(item);
      }
    } else if constexpr (archive_detail::Composite<T, ArchiveReader>) {
      value.archive(*this);
    } else {
      static_assert(archive_detail::Plain<T>, "give the type an archive() member");
      if (head(sizeof(T)) != 1) throw ArchiveMismatch("it holds another number of values");
      copy(&value, sizeof(T));
    }
  }
  std::size_t head(std::size_t size);  ///< the count of the next item, whose elements must be of that size
  void copy(void* to, std::size_t size);
  std::string_view bytes_;
};

/// Writes `bytes` under the content key, aside, then renames. Throws EnvironmentError naming the path.
void write_checkpoint(const std::filesystem::path& path, std::string_view content, std::string_view bytes);

/// What came of a look for a checkpoint.
struct CheckpointLoad {
  bool loaded = false;
  std::string note;  ///< why a file that is there was not used; "" when used or when there is none
};

/// The bytes of the checkpoint when it is whole and belongs to `content`.
CheckpointLoad read_checkpoint(const std::filesystem::path& path, std::string_view content, std::string& bytes);

template <class State>
void save_checkpoint(const std::filesystem::path& path, std::string_view content, const State& state) {
  ArchiveWriter writer;
  writer(state);
  write_checkpoint(path, content, writer.bytes());
}

/// Fills `state` when the checkpoint can be used; else leaves it as it is. State must be copyable.
template <class State>
CheckpointLoad load_checkpoint(const std::filesystem::path& path, std::string_view content, State& state) {
  std::string bytes;
  CheckpointLoad load = read_checkpoint(path, content, bytes);
  if (!load.loaded) return load;
  try {
    State read = state;
    ArchiveReader reader(bytes);
    reader(read);
    if (!reader.at_end()) throw ArchiveMismatch("it holds more than expected");
    state = std::move(read);
  } catch (const ArchiveMismatch& mismatch) {
    return {false, "checkpoint " + path.string() + " is not used: " + mismatch.what()};
  }
  return load;
}

}  // namespace dem
