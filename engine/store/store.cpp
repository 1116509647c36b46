#include "engine/store/store.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <mutex>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/store/hdf5_handle.h"

namespace dem {
namespace {

namespace fs = std::filesystem;
using store_detail::Handle;
using store_detail::Hdf5Error;
using store_detail::QuietErrors;
using store_detail::require;

using Text = std::string;
using Attributes = std::vector<std::pair<std::string, std::string>>;

constexpr const char* record_format = "dem-report record 2";
constexpr const char* table_format = "dem-report tables 1";
constexpr const char* index_name = "table_index";  // marks a group as a table and keeps the order of tables
constexpr hsize_t chunk_values = 65536;

/// HDF5 keeps its state in one place and may be built without locks: one thread at a time, whatever the files.
std::mutex hdf5_mutex;

// ---- writing ----

/// Objects without time stamps, with links and attributes in the order of their creation.
Handle creation(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose, "make a property list");
  require(H5Pset_obj_track_times(list, false), "switch time stamps off");
  require(H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "keep the order");
  if (kind != H5P_DATASET_CREATE) {
    require(H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "keep the order");
  }
  return list;
}

/// A file that lives in memory until it is whole, so that a full disk is met by write_file() alone.
Handle new_file() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a property list");
  require(H5Pset_fapl_core(access, 1 << 20, false), "work in memory");
  require(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choose the file version");
  const Handle create = creation(H5P_FILE_CREATE);
  return {H5Fcreate("record", H5F_ACC_TRUNC, create, access), H5Fclose, "create a file"};
}

/// The bytes as the core driver holds them. (H5Fget_file_image clears a flag but not its checksum in this file
/// version.)
std::string image(hid_t file) {
  require(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw Hdf5Error("cannot size the file");
  void* memory = nullptr;
  require(H5Fget_vfd_handle(file, H5P_DEFAULT, &memory), "find the file in memory");
  return {*static_cast<char**>(memory), static_cast<std::size_t>(size)};
}

Handle group(hid_t parent, const std::string& name) {
  const Handle create = creation(H5P_GROUP_CREATE);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, create, H5P_DEFAULT), H5Gclose, "create group " + name};
}

void put(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar");
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "create attribute " + name);
  require(H5Awrite(attribute, type, value), "write attribute " + name);
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  require(H5Tset_size(type, std::max<std::size_t>(size, 1)), "size a text");
  require(H5Tset_strpad(type, H5T_STR_NULLPAD), "pad a text");
  require(H5Tset_cset(type, H5T_CSET_UTF8), "make a text UTF-8");
  return type;
}

void put(hid_t object, const std::string& name, const Text& value) {
  put(object, name, text_type(value.size()), value.c_str());
}
void put(hid_t object, const std::string& name, double value) { put(object, name, H5T_IEEE_F64LE, &value); }
void put(hid_t object, const std::string& name, std::int32_t value) { put(object, name, H5T_STD_I32LE, &value); }
void put(hid_t object, const std::string& name, std::uint64_t value) { put(object, name, H5T_STD_U64LE, &value); }

void write_column(hid_t parent, const Column& column, const std::string& table) {
  const std::size_t size = std::visit([](const auto& values) { return values.size(); }, column.values);
  const auto width = static_cast<hsize_t>(column.width);
  if (width == 0 || size % width != 0) {
    throw std::logic_error("column " + table + "/" + column.name + " does not fill its rows");
  }
  const int rank = width > 1 ? 2 : 1;
  const std::array<hsize_t, 2> shape = {size / width, width};
  const Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, "shape " + column.name);
  const Handle create = creation(H5P_DATASET_CREATE);
  if (size > 0) {
    const std::array<hsize_t, 2> chunk = {std::min(shape[0], std::max<hsize_t>(chunk_values / width, 1)), width};
    require(H5Pset_chunk(create, rank, chunk.data()), "cut " + column.name + " in chunks");
    require(H5Pset_shuffle(create), "shuffle " + column.name);
    require(H5Pset_deflate(create, 4), "compress " + column.name);
  }
  const bool real = std::holds_alternative<std::vector<double>>(column.values);
  const hid_t type = real ? H5T_IEEE_F64LE : H5T_STD_I32LE;
  const Handle data(H5Dcreate2(parent, column.name.c_str(), type, space, H5P_DEFAULT, create, H5P_DEFAULT), H5Dclose,
                    "create column " + column.name);
  const void* values = std::visit([](const auto& v) -> const void* { return v.data(); }, column.values);
  if (size > 0) require(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write " + column.name);
  put(data, "unit", column.unit);
}

/// The group of a table, those above it made when missing: "snapshots/0000".
Handle table_group(hid_t file, const std::string& name) {
  for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
    const std::string above = name.substr(0, slash);
    if (H5Lexists(file, above.c_str(), H5P_DEFAULT) <= 0) group(file, above);
  }
  if (H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0) {
    return {H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + name};
  }
  return group(file, name);
}

void put_tables(hid_t file, const std::vector<Table>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Table& table = tables[i];
    const Handle at = table_group(file, table.name);
    put(at, index_name, static_cast<std::int32_t>(i));
    for (const auto& [name, value] : table.attributes) put(at, name, value);
    for (const Column& column : table.columns) write_column(at, column, table.name);
  }
}

/// What follows the HDF5 file, where HDF5 does not look. Its own checksums leave parts of a file unguarded.
std::string trailer(std::string_view bytes) { return "\nsha256 " + sha256(bytes) + "\n"; }

/// Runs `fill` on a file in memory and writes it out; HDF5's errors name the path.
template <class Fill>
void write(const fs::path& path, Fill fill) {
  std::string bytes;
  try {
    const std::lock_guard alone(hdf5_mutex);
    const QuietErrors quiet;
    const Handle file = new_file();
    fill(file);
    bytes = image(file);
  } catch (const Hdf5Error& error) {
    throw EnvironmentError("cannot write " + path.string() + ": HDF5 " + error.what());
  }
  write_file(path, bytes + trailer(bytes));
}

// ---- reading ----

template <class Use>
auto read(const fs::path& path, Use use) {
  const std::string bytes = read_file(path);
  const std::size_t size = bytes.size() - std::min(bytes.size(), trailer("").size());
  if (std::string_view(bytes).substr(size) != trailer(std::string_view(bytes).substr(0, size))) {
    throw EnvironmentError("cannot read " + path.string() + ": it is cut short, damaged or from another program");
  }
  try {
    const std::lock_guard alone(hdf5_mutex);
    const QuietErrors quiet;
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open it");
    return use(file);
  } catch (const Hdf5Error& failure) {
    throw EnvironmentError("cannot read " + path.string() + ": HDF5 " + failure.what());
  } catch (const std::bad_variant_access&) {
    throw EnvironmentError("cannot read " + path.string() + ": an attribute is of another type than expected");
  }
}

using Scalar = std::variant<double, std::string, std::int32_t, std::uint64_t>;

Scalar get_scalar(hid_t attribute, const std::string& name) {
  const Handle type(H5Aget_type(attribute), H5Tclose, "read the type of " + name);
  const auto number = [&]<class T>(hid_t memory, T value) -> Scalar {
    require(H5Aread(attribute, memory, &value), "read attribute " + name);
    return value;
  };
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return number(H5T_NATIVE_DOUBLE, 0.0);
    case H5T_INTEGER:
      return H5Tget_size(type) == 8 ? number(H5T_NATIVE_UINT64, std::uint64_t{0})
                                    : number(H5T_NATIVE_INT32, std::int32_t{0});
    case H5T_STRING: {
      if (H5Tis_variable_str(type) != 0) break;
      std::string value(H5Tget_size(type), '\0');
      require(H5Aread(attribute, type, value.data()), "read attribute " + name);
      value.resize(value.find_last_not_of('\0') + 1);
      return value;
    }
    default:
      break;
  }
  throw Hdf5Error("cannot read attribute " + name + ": another type than expected");
}

std::vector<std::pair<std::string, Scalar>> get_all(hid_t object) {
  H5O_info_t info{};
  require(H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS), "count attributes");
  std::vector<std::pair<std::string, Scalar>> all;
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const Handle attribute(H5Aopen_by_idx(object, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "open an attribute");
    const ssize_t length = H5Aget_name(attribute, 0, nullptr);
    if (length < 0) throw Hdf5Error("cannot read the name of an attribute");
    std::string name(static_cast<std::size_t>(length), '\0');
    H5Aget_name(attribute, name.size() + 1, name.data());
    all.emplace_back(name, get_scalar(attribute, name));
  }
  return all;
}

template <class T>
T get(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
  const Scalar value = get_scalar(attribute, name);
  if (const T* found = std::get_if<T>(&value)) return *found;
  throw Hdf5Error("cannot read attribute " + name + ": another type than expected");
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "find group " + name};
}

Column read_column(hid_t parent, const std::string& name) {
  const Handle data(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "open column " + name);
  const Handle space(H5Dget_space(data), H5Sclose, "read the shape of " + name);
  const Handle type(H5Dget_type(data), H5Tclose, "read the type of " + name);
  std::array<hsize_t, 2> shape = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, shape.data(), nullptr) < 0) {
    throw Hdf5Error("cannot read column " + name + ": another shape than expected");
  }
  Column column{name, get<Text>(data, "unit"), static_cast<int>(shape[1]), {}};
  const auto fill = [&](hid_t memory, auto values) {
    values.resize(shape[0] * shape[1]);
    if (!values.empty()) {
      require(H5Dread(data, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read column " + name);
    }
    column.values = std::move(values);
  };
  if (H5Tget_class(type) == H5T_FLOAT) {
    fill(H5T_NATIVE_DOUBLE, std::vector<double>());
  } else {
    fill(H5T_NATIVE_INT32, std::vector<std::int32_t>());
  }
  return column;
}

struct Link {
  std::string name;
  bool is_group = false;
};

std::vector<Link> links(hid_t parent) {
  H5G_info_t info{};
  require(H5Gget_info(parent, &info), "list a group");
  std::vector<Link> all;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const ssize_t length = H5Lget_name_by_idx(parent, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
    if (length < 0) throw Hdf5Error("cannot list a group");
    std::string name(static_cast<std::size_t>(length), '\0');
    H5Lget_name_by_idx(parent, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name.data(), name.size() + 1, H5P_DEFAULT);
    const Handle object(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose, "open " + name);
    all.push_back({name, H5Iget_type(object) == H5I_GROUP});
  }
  return all;
}

Table read_table(hid_t at, const std::string& name) {
  Table table{name, {}, {}};
  for (auto& [key, value] : get_all(at)) {
    if (key != index_name) table.attributes.emplace_back(key, std::get<Text>(value));
  }
  for (const Link& link : links(at)) {
    if (!link.is_group) table.columns.push_back(read_column(at, link.name));
  }
  return table;
}

/// Finds the tables below `parent`, by their index.
void collect_tables(hid_t parent, const std::string& path, std::map<std::int32_t, Table>& tables) {
  for (const Link& link : links(parent)) {
    if (!link.is_group) continue;
    const Handle at = open_group(parent, link.name);
    const std::string name = path.empty() ? link.name : path + "/" + link.name;
    if (H5Aexists(at, index_name) > 0) tables[get<std::int32_t>(at, index_name)] = read_table(at, name);
    collect_tables(at, name, tables);
  }
}

std::vector<Table> get_tables(hid_t file) {
  std::map<std::int32_t, Table> found;
  collect_tables(file, "", found);
  std::vector<Table> tables;
  for (auto& [index, table] : found) tables.push_back(std::move(table));
  return tables;
}

void expect_format(hid_t object, const std::string& format) {
  const auto found = H5Aexists(object, "format") > 0 ? get<Text>(object, "format") : Text("another format");
  if (found != format) throw Hdf5Error("opened it, but it is " + found + ", not " + format);
}

Handle open_case(hid_t file) {
  if (H5Lexists(file, "case", H5P_DEFAULT) <= 0) throw Hdf5Error("opened it, but it holds no record");
  Handle at = open_group(file, "case");
  expect_format(at, record_format);
  return at;
}

}  // namespace

void write_record(const Record& record, const fs::path& path) {
  write(path, [&](hid_t file) {
    const Handle at = group(file, "case");
    put(at, "format", Text(record_format));
    put(at, "model", record.model);
    put(at, "scenario", record.scenario);
    put(at, "case_id", record.case_id);
    put(at, "content", record.content);
    put(at, "physics_version", record.physics_version);
    put(at, "seed", record.seed);
    const Handle parameters = group(file, "parameters");
    for (const auto& [name, value] : record.parameters) {
      std::visit([&, &key = name](const auto& v) { put(parameters, key, v); }, value);
    }
    const Handle results = group(file, "results");
    const Handle units = group(file, "units");
    for (const auto& [name, value] : record.results) {
      put(results, name, value);
      put(units, name, Text(find_quantity(record.quantities, name).unit));
    }
    const Handle checks = group(file, "checks");
    for (const Check& check : record.checks) {
      const Handle one = group(checks, check.id);
      put(one, "value", check.value);
      put(one, "limit", check.limit);
      put(one, "held", std::int32_t{check.held});
      put(one, "meaning", check.meaning);
    }
    const Handle notes = group(file, "notes");
    for (std::size_t i = 0; i < record.notes.size(); ++i) {
      std::array<char, 24> name{};
      std::snprintf(name.data(), name.size(), "%04zu", i);
      put(notes, name.data(), record.notes[i]);
    }
    put_tables(file, record.tables);
  });
}

Record read_record(const fs::path& path) {
  return read(path, [](hid_t file) {
    Record record;
    const Handle at = open_case(file);
    record.model = get<Text>(at, "model");
    record.scenario = get<Text>(at, "scenario");
    record.case_id = get<Text>(at, "case_id");
    record.content = get<Text>(at, "content");
    record.physics_version = get<Text>(at, "physics_version");
    record.seed = get<std::uint64_t>(at, "seed");
    for (auto& [name, value] : get_all(open_group(file, "parameters"))) {
      if (const auto* number = std::get_if<double>(&value)) {
        record.parameters.emplace_back(name, *number);
      } else {
        record.parameters.emplace_back(name, std::get<Text>(value));
      }
    }
    for (auto& [name, value] : get_all(open_group(file, "results"))) {
      record.results.emplace_back(name, std::get<double>(value));
    }
    const Handle checks = open_group(file, "checks");
    for (const Link& link : links(checks)) {
      const Handle one = open_group(checks, link.name);
      record.checks.push_back({link.name, get<double>(one, "value"), get<double>(one, "limit"),
                               get<std::int32_t>(one, "held") != 0, get<Text>(one, "meaning")});
    }
    for (auto& [name, value] : get_all(open_group(file, "notes"))) record.notes.push_back(std::get<Text>(value));
    record.tables = get_tables(file);
    return record;
  });
}

std::string read_content(const fs::path& path) {
  return read(path, [](hid_t file) { return get<Text>(open_case(file), "content"); });
}

const Table& TableFile::table(std::string_view name) const {
  const auto at = std::ranges::find(tables, name, &Table::name);
  if (at == tables.end()) throw std::out_of_range("there is no table '" + std::string(name) + "'");
  return *at;
}

std::string TableFile::attribute(std::string_view key) const {
  const auto at = std::ranges::find(attributes, key, &std::pair<std::string, std::string>::first);
  return at == attributes.end() ? std::string() : at->second;
}

void write_tables(const fs::path& path, const Attributes& attributes, const std::vector<Table>& tables) {
  write(path, [&](hid_t file) {
    const Handle root = open_group(file, "/");
    put(root, "format", Text(table_format));
    for (const auto& [name, value] : attributes) put(root, name, value);
    put_tables(file, tables);
  });
}

TableFile read_tables(const fs::path& path) {
  return read(path, [](hid_t file) {
    const Handle root = open_group(file, "/");
    expect_format(root, table_format);
    TableFile content;
    for (auto& [name, value] : get_all(root)) {
      if (name != "format") content.attributes.emplace_back(name, std::get<Text>(value));
    }
    content.tables = get_tables(file);
    return content;
  });
}

}  // namespace dem
