// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE npy
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

#include <cambium/io.hpp>

using cambium::Vec;

namespace {

/// A file that is removed when the test is over.
struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("cambium_npy_test_" + std::to_string(::getpid()) + ".npy");
  ~TemporaryFile() { std::filesystem::remove(path); }

  std::string read() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

/// Checks the fixed parts of the format and returns what follows the header.
std::string payload(const std::string& file, const std::string& type, const std::string& shape) {
  BOOST_REQUIRE(file.size() > 10);
  BOOST_TEST(file.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = static_cast<unsigned char>(file[8]) + 256u * static_cast<unsigned char>(file[9]);
  BOOST_TEST((10 + length) % 64 == 0u);
  const std::string header = file.substr(10, length);
  BOOST_TEST(header.back() == '\n');
  BOOST_TEST(header.find("{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }") == 0u);
  return file.substr(10 + length);
}

template <class T>
std::vector<T> numbers(const std::string& bytes) {
  std::vector<T> result(bytes.size() / sizeof(T));
  std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_field_has_its_last_axis_first) {
  const TemporaryFile file;
  cambium::Field<double, 2> field(cambium::Lattice<2>(cambium::Box<2>{{0, 0}, {3, 2}}, 1.0, {true, true}));
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = 0.5 + static_cast<double>(i);
  write_npy(file.path, field);
  const auto values = numbers<double>(payload(file.read(), "<f8", "2, 3, "));
  BOOST_TEST(values == (std::vector<double>{0.5, 1.5, 2.5, 3.5, 4.5, 5.5}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(components_are_the_last_axis) {
  const TemporaryFile file;
  cambium::Field<Vec<2, float>, 1> field(cambium::Lattice<1>::periodic_box(cambium::Box<1>::cube(), 3));
  field[1] = {1.0F, 2.0F};
  write_npy(file.path, field);
  const auto values = numbers<float>(payload(file.read(), "<f4", "3, 2, "));
  BOOST_TEST(values == (std::vector<float>{0, 0, 1, 2, 0, 0}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(columns_are_rows_of_the_file) {
  const TemporaryFile file;
  std::vector<double> x{1, 2, 3};
  std::vector<double> y{4, 5, 6};
  write_npy(file.path, cambium::Columns<2, double>({x.data(), y.data()}, 3));
  const auto values = numbers<double>(payload(file.read(), "<f8", "2, 3, "));
  BOOST_TEST(values == (std::vector<double>{1, 2, 3, 4, 5, 6}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(integers_and_empty_arrays) {
  const TemporaryFile file;
  const std::vector<int> none;
  const std::size_t shape[1] = {0};
  cambium::write_npy<int>(file.path, none, shape);
  BOOST_TEST(payload(file.read(), "<i4", "0, ").empty());
}

BOOST_AUTO_TEST_CASE(bad_calls_are_refused) {
  const std::vector<double> values(6);
  const std::size_t shape[2] = {2, 4};
  BOOST_CHECK_THROW(cambium::write_npy<double>("never_written.npy", values, shape), cambium::SizeError);
  BOOST_TEST(!std::filesystem::exists("never_written.npy"));
  const std::size_t fits[2] = {2, 3};
  BOOST_CHECK_THROW(cambium::write_npy<double>("/no/such/folder/a.npy", values, fits), cambium::FileError);
  if (std::filesystem::exists("/dev/full")) {
    BOOST_CHECK_THROW(cambium::write_npy<double>("/dev/full", values, fits), cambium::FileError);
  }
}
