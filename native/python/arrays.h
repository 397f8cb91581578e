// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy arrays go in as checked views of the caller's memory, and come out as read-only arrays that
// keep their owner alive.
#pragma once

#include <medial/errors.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <climits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/stopwatch.h"
#include "base/vec3.h"

namespace medial::python {

namespace py = pybind11;

inline std::string describe(const py::handle& object) {
  if (!py::isinstance<py::array>(object))
    return "an object of type " + std::string(py::str(py::type::handle_of(object)));
  return "shape " + std::string(py::str(object.attr("shape"))) + " of " +
         std::string(py::str(object.attr("dtype")));
}

// `columns` columns, one of the dtype kinds ('f' float, 'i' int, 'u' unsigned).
inline py::array checked_rows(const py::handle& object, const char* name, int columns,
                              const std::string& kinds, const char* expected) {
  const bool array = py::isinstance<py::array>(object);
  auto view = array ? py::reinterpret_borrow<py::array>(object) : py::array();
  if (!array || view.ndim() != 2 || view.shape(1) != columns ||
      kinds.find(view.dtype().kind()) == std::string::npos) {
    throw InvalidInputError("Expected " + std::string(name) + " as " + expected + ", found " +
                            describe(object) + "; convert it.");
  }
  if (view.shape(0) > INT_MAX / 8) {
    throw InvalidInputError("Expected at most " + std::to_string(INT_MAX / 8) + " " + name +
                            ", found " + std::to_string(view.shape(0)) + "; thin them.");
  }
  return view;
}

// This takes an (n, 3) float array as points: a view if it is C-contiguous float64, else a
// converted copy.
class Points {
 public:
  Points(const py::handle& object, const char* name)
      : rows_(py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
            checked_rows(object, name, 3, "f", "an (n, 3) float64 array"))) {}

  std::span<const Vec3> span() const {
    return {reinterpret_cast<const Vec3*>(rows_.data()), static_cast<size_t>(rows_.shape(0))};
  }

 private:
  py::array_t<double, py::array::c_style | py::array::forcecast> rows_;
};

// How messages name an array of ids, and the least of these.
struct IdWords {
  const char *name, *expected, *ids, *remedy;
  long long least;
};

// This takes an integer array as rows of ids, or None for none: a view if it is C-contiguous int32,
// else a checked copy.
template <size_t columns>
class IdRows {
 public:
  IdRows(const py::handle& object, const IdWords& words) {
    if (object.is_none()) return;
    const py::array view = checked_rows(object, words.name, columns, "iu", words.expected);
    if (view.size() > 0 && !py::isinstance<py::array_t<int32_t>>(view)) {
      const auto low = view.attr("min")().cast<long long>();
      const auto high = view.attr("max")().cast<long long>();
      if (low < words.least || high > INT_MAX) {
        throw InvalidInputError(
            "Expected " + std::string(words.ids) + " that fit an int32, found " +
            std::to_string(low < words.least ? low : high) + "; " + words.remedy + ".");
      }
    }
    rows_ = py::array_t<int32_t, py::array::c_style | py::array::forcecast>::ensure(view);
  }

  std::span<const std::array<int32_t, columns>> span() const {
    if (rows_.ndim() != 2) return {};
    return {reinterpret_cast<const std::array<int32_t, columns>*>(rows_.data()),
            static_cast<size_t>(rows_.shape(0))};
  }

 private:
  py::array_t<int32_t, py::array::c_style | py::array::forcecast> rows_;
};

struct Triangles : IdRows<3> {
  explicit Triangles(const py::handle& object)
      : IdRows(object, {"triangles", "an (m, 3) int32 array", "triangle corners",
                        "rebuild the faces", INT_MIN}) {}
};

// Marked edges.
struct EdgeRows : IdRows<2> {
  explicit EdgeRows(const py::handle& object)
      : IdRows(object, {"sharp_edges", "an (e, 2) int32 array", "rows of sharp_edges",
                        "mark the edges again", 0}) {}
};

// Returns a view of the caller's column. Other types, and arrays that are not contiguous, would
// need a copy and are refused. `expected` describes the type in NumPy's words.
template <typename T>
std::span<const T> column_of(const py::object& column, const char* name, const char* expected) {
  using Column = py::array_t<T, py::array::c_style>;
  if (!py::isinstance<Column>(column) || py::cast<Column>(column).ndim() != 1) {
    throw InvalidInputError("Expected " + std::string(name) + " as a contiguous " + expected +
                            " array, found " + describe(column) + "; convert it.");
  }
  const auto view = py::reinterpret_borrow<Column>(column);
  return {view.data(), static_cast<size_t>(view.size())};
}

inline std::span<const int32_t> ids_of(const py::object& ids, const char* name) {
  return column_of<int32_t>(ids, name, "(m,) int32");
}

inline std::span<const uint8_t> flags_of(const py::object& flags, const char* name) {
  const auto view = column_of<bool>(flags, name, "(n,) bool");
  return {reinterpret_cast<const uint8_t*>(view.data()), view.size()};
}

// Returns the rows of edges that Python owns.
inline std::span<const Edge> edges_of(const py::object& edges, const char* name = "edges",
                                      const char* shape = "(w, 2)") {
  using Rows = py::array_t<int32_t, py::array::c_style>;
  if (!py::isinstance<Rows>(edges) || py::cast<Rows>(edges).ndim() != 2 ||
      py::cast<Rows>(edges).shape(1) != 2) {
    throw InvalidInputError("Expected " + std::string(name) + " as a contiguous " + shape +
                            " int32 array, found " + describe(edges) + "; convert it.");
  }
  const auto view = py::reinterpret_borrow<Rows>(edges);
  return {reinterpret_cast<const Edge*>(view.data()), static_cast<size_t>(view.shape(0))};
}

// The type of the numbers in a row: a Vec3, an array such as an Edge, an enum, or a number itself.
template <typename Row>
struct NumberIn
    : std::conditional_t<std::is_enum_v<Row>, std::underlying_type<Row>, std::type_identity<Row>> {
};
template <>
struct NumberIn<Vec3> : std::type_identity<double> {};
template <typename T, size_t columns>
struct NumberIn<std::array<T, columns>> : std::type_identity<T> {};

// Returns rows as a read-only array with one column per number in a row (no second axis for one).
// The numbers may be of another type of the same size: flags are bool.
template <typename Number = void, typename Rows>
py::array view_of(const Rows& rows, const py::handle& owner) {
  using Row = typename Rows::value_type;
  using Scalar = std::conditional_t<std::is_void_v<Number>, typename NumberIn<Row>::type, Number>;
  constexpr auto columns = static_cast<py::ssize_t>(sizeof(Row) / sizeof(Scalar));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size())};
  if (columns > 1) shape.push_back(columns);
  py::array_t<Scalar> array(shape, reinterpret_cast<const Scalar*>(rows.data()), owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// Adds a property that is a view of a vector inside the object.
template <typename Number = void, typename Class, typename Owner, typename Rows>
void add_view(Class& c, const char* name, Rows Owner::*member, const char* doc) {
  const auto view = [member](const py::object& self) {
    return view_of<Number>(self.cast<const Owner&>().*member, self);
  };
  c.def_property_readonly(name, view, doc);
}

// Hands a result over to Python.
template <typename Number = void, typename Rows>
py::array array_of(Rows rows) {
  auto* kept = new Rows(std::move(rows));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Rows*>(p); });
  return view_of<Number>(*kept, owner);
}

// Hands several results over, each as an array.
template <typename... Rows>
py::tuple arrays_of(Rows... rows) {
  return py::make_tuple(array_of(std::move(rows))...);
}

// Returns the values of an enum, each as a T.
template <typename T = int32_t, typename Values>
py::array numbers_of(const Values& values) {
  std::vector<T> numbers;
  numbers.reserve(values.size());
  for (const auto value : values) numbers.push_back(static_cast<T>(value));
  return array_of(std::move(numbers));
}

// Does some work while other threads of Python may run.
template <typename Work>
auto released(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

inline py::dict seconds(const Timings& timings) {
  py::dict result;
  for (const auto& [stage, time] : timings) result[stage.c_str()] = time;
  return result;
}

inline int thread_argument(int threads) {
  if (threads < 0 || threads > 1024) {
    throw InvalidInputError("Expected 0 to 1024 threads, found " + std::to_string(threads) +
                            "; 0 takes all cores.");
  }
  return threads;
}

}  // namespace medial::python
