#pragma once
// Inside of engine/store: HDF5's C handles with an owner, its errors as exceptions.
#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace dem::store_detail {

/// What HDF5 refuses; the public functions add the path and turn it into an EnvironmentError.
struct Hdf5Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Silences HDF5's own printing to stderr while it lives.
class QuietErrors {
 public:
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one id; closed by the function that belongs to its kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) throw Hdf5Error("cannot " + what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

inline void require(herr_t status, const std::string& what) {
  if (status < 0) throw Hdf5Error("cannot " + what);
}

}  // namespace dem::store_detail
