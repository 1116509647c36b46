#include "engine/core/record.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace dem {
namespace {

template <class Items, class Get>
auto find_named(Items& items, std::string_view name, Get get) -> decltype(&*items.begin()) {
  for (auto& item : items) {
    if (get(item) == name) return &item;
  }
  return nullptr;
}

const auto by_name = [](const auto& item) -> std::string_view { return item.name; };
const auto by_first = [](const auto& item) -> std::string_view { return item.first; };

[[noreturn]] void missing(const std::string& what, std::string_view name) {
  throw std::out_of_range(what + " has no '" + std::string(name) + "'");
}

template <class T>
std::span<const T> typed(const Table& table, std::string_view name) {
  const Column* column = find_named(table.columns, name, by_name);
  const auto* values = column ? std::get_if<std::vector<T>>(&column->values) : nullptr;
  if (!values) missing("table " + table.name, name);
  return *values;
}

}  // namespace

void Table::add(std::string column, std::string unit, std::vector<double> values, int width) {
  columns.push_back({std::move(column), std::move(unit), width, std::move(values)});
}
void Table::add(std::string column, std::string unit, std::vector<std::int32_t> values, int width) {
  columns.push_back({std::move(column), std::move(unit), width, std::move(values)});
}
bool Table::has(std::string_view column) const { return find_named(columns, column, by_name) != nullptr; }
std::span<const double> Table::real(std::string_view column) const { return typed<double>(*this, column); }
std::span<const std::int32_t> Table::integer(std::string_view column) const {
  return typed<std::int32_t>(*this, column);
}
std::size_t Table::rows() const {
  if (columns.empty()) return 0;
  const Column& first = columns.front();
  return std::visit([&](const auto& v) { return v.size() / static_cast<std::size_t>(first.width); }, first.values);
}
std::string Table::attribute(std::string_view key) const {
  const auto* found = find_named(attributes, key, by_first);
  return found ? found->second : std::string();
}

const Table* Record::find(std::string_view name) const { return find_named(tables, name, by_name); }
const Table& Record::table(std::string_view name) const {
  const Table* found = find(name);
  if (!found) missing("record of " + case_id, name);
  return *found;
}

namespace {

// "mineral_share.*" and "quartz" -> "mineral_share.quartz"
std::string member_id(const Quantity& family, std::string_view member) {
  if (!family.family()) throw std::logic_error("'" + std::string(family.id) + "' has no members");
  return std::string(family.id.substr(0, family.id.size() - 1)) + std::string(member);
}

void add(Record& record, std::string id, double value) {
  const auto covers = [&](const Quantity& q) { return q.covers(id); };
  if (std::ranges::none_of(record.quantities, covers)) {
    throw std::logic_error("the model '" + record.model + "' does not declare the result '" + id + "'");
  }
  if (record.find_result(id)) throw std::logic_error("the result '" + id + "' is put twice");
  record.results.emplace_back(std::move(id), value);
}

}  // namespace

void Record::put(const Quantity& quantity, double value) {
  if (quantity.family()) throw std::logic_error("'" + std::string(quantity.id) + "' needs a member");
  add(*this, std::string(quantity.id), value);
}
void Record::put(const Quantity& family, std::string_view member, double value) {
  add(*this, member_id(family, member), value);
}
const double* Record::find_result(std::string_view id) const {
  const auto* found = find_named(results, id, by_first);
  return found ? &found->second : nullptr;
}
bool Record::has(const Quantity& quantity) const { return find_result(quantity.id) != nullptr; }
double Record::value(const Quantity& quantity) const {
  const double* found = find_result(quantity.id);
  if (!found) missing("record of " + case_id, quantity.id);
  return *found;
}
double Record::value_or_nan(const Quantity& quantity) const {
  const double* found = find_result(quantity.id);
  return found ? *found : std::numeric_limits<double>::quiet_NaN();
}
double Record::value_or_nan(const Quantity& family, std::string_view member) const {
  const double* found = find_result(member_id(family, member));
  return found ? *found : std::numeric_limits<double>::quiet_NaN();
}
double Record::number(std::string_view parameter) const {
  const ParameterValue* found = find_value(parameters, parameter);
  const double* value = found ? std::get_if<double>(found) : nullptr;
  if (!value) missing("parameters of " + case_id, parameter);
  return *value;
}
std::string Record::text(std::string_view parameter) const {
  const ParameterValue* found = find_value(parameters, parameter);
  const std::string* value = found ? std::get_if<std::string>(found) : nullptr;
  if (!value) missing("parameters of " + case_id, parameter);
  return *value;
}

}  // namespace dem
