// MATLAB and TDMS files as campaigns: which variables, structs and groups are columns and tests.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "guess/guess.h"
#include "io/file_streams.h"
#include "support/run_command.h"
#include "support/tdms_bytes.h"
#include "unit/load_case.h"

namespace frictab::load_mat_test {

using data::Dataset;
using data::load_dataset;

namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

// columns() has SYNTHETIC rows of a test; v73() writes what MATLAB's save -v7.3 does.
constexpr const char* head = R"(
import numpy, scipy.io, h5py
def columns(first=0, rows=20):
  p = numpy.linspace(500, 900, rows) + first
  return dict(time_s=numpy.arange(rows)*0.1, sigma_n_MPa=p, tau_R_MPa=0.1*p, v_rel_mm_s=numpy.full(rows, 5.0))
def save(packed=True, **variables): scipy.io.savemat('a.mat', variables, do_compression=packed)
def put(f, where, name, value):
  if isinstance(value, dict):
    g = where.create_group(name); g.attrs['MATLAB_class'] = numpy.bytes_('struct')
    for key, one in value.items(): put(f, g, key, one)
  elif isinstance(value, list):
    refs = numpy.empty((len(value), 1), dtype=h5py.ref_dtype)
    for i, one in enumerate(value):
      key = 'r%d' % len(f['#refs#']); put(f, f['#refs#'], key, one); refs[i, 0] = f['#refs#'][key].ref
    where.create_dataset(name, data=refs, dtype=h5py.ref_dtype).attrs['MATLAB_class'] = numpy.bytes_('cell')
  elif isinstance(value, str):
    d = where.create_dataset(name, data=numpy.array([[ord(c)] for c in value], dtype='u2'))
    d.attrs['MATLAB_class'] = numpy.bytes_('char')
  else:
    d = where.create_dataset(name, data=numpy.atleast_2d(value)); d.attrs['MATLAB_class'] = numpy.bytes_('double')
def v73(block=512, **variables):
  with h5py.File('a.mat', 'w', userblock_size=block) as f:
    f.create_group('#refs#')
    for name, value in variables.items(): put(f, f, name, value)
  with open('a.mat', 'r+b') as f: f.write(b'MATLAB 7.3 MAT-file'.ljust(116) + bytes(8) + b'\0\2IM')
)";

class LoadMat : public test::LoadCase {
protected:
  void write(const std::string& statements) {
    const auto [code, out, err] =
        test::run_command({FRICTAB_PYTHON, "-c", head + statements}, directory_);
    ASSERT_EQ(code, 0) << err;
  }
  Dataset read_mat() { return load_dataset({"a.mat"}, options); }
  std::string mat_fault() { return fault_of({"a.mat"}); }
};

TEST_F(LoadMat, VectorsAreColumnsInEveryVersion) {
  for (const char* how : {"save(**columns())", "save(False, **columns())",
                          "scipy.io.savemat('a.mat', columns(), format='4')", "v73(**columns())",
                          "v73(2048, **columns())"}) {
    write(how);
    const Dataset data = read_mat();
    EXPECT_EQ(data.rows(), 20u) << how;
    EXPECT_DOUBLE_EQ(data.values("sigma_n_MPa")[19], 900) << how;
  }
}

TEST_F(LoadMat, StructsOfOneFormAreATestEach) {
  for (const char* how :
       {"save(t01=columns(), t02=columns(1))", "v73(t01=columns(), t02=columns(1))",
        "save(all=dict(t01=columns(), t02=columns(1)))"}) {
    write(how);
    EXPECT_EQ(read_mat().experiments.size(), 2u) << how;
    EXPECT_EQ(read_mat().rows(), 40u) << how;
  }
}

TEST_F(LoadMat, AnElementOfAStructArrayOrOfACellOfStructsIsATest) {
  write("save(tests=[columns(), columns(1)])");
  EXPECT_THAT(read_mat().experiments, ElementsAre("tests{1}", "tests{2}"));
  write("a = numpy.empty((2, 1), dtype=[(k, object) for k in columns()])\n"
        "for i in (0, 1):\n  for k, v in columns(i).items(): a[k][i, 0] = v\n"
        "save(tests=a)");
  EXPECT_THAT(read_mat().experiments, ElementsAre("tests(1)", "tests(2)"));
}

TEST_F(LoadMat, OneStructIsTheFileAndMayBeNamedByItsPath) {
  write("save(rig=columns(), comment='first')");
  EXPECT_THAT(read_mat().experiments, ElementsAre("a"));
  write("c = columns(); c['druck'] = c.pop('sigma_n_MPa')\nsave(rig=c)");
  options.columns["sigma_n_MPa"].names = {"rig.druck"};
  options.columns["tau_R_MPa"].names = {"rig.tau_R_MPa"};
  EXPECT_EQ(read_mat().rows(), 20u);
}

TEST_F(LoadMat, TextsScalarsLogicalAndMatricesAreRead) {
  for (const char* how : {"save", "v73"}) {
    write(fmt::format("cells = ['oil' if i % 2 else 'dry' for i in range(20)]\n"
                      "cells = cells if '{0}' == 'v73' else numpy.array(cells, dtype=object)\n"
                      "{0}(**columns(), sigma_f_MPa=480.0, film=cells)",
                      how));
    EXPECT_THAT(column(read_mat(), "sigma_f_MPa"), Each(480)) << how;
    EXPECT_THAT(read_mat().find("film")->levels, testing::UnorderedElementsAre("dry", "oil"))
        << how;
  }
  write("save(**columns(), on=numpy.arange(20) > 9, coil=numpy.arange(40.0).reshape(20, 2))");
  EXPECT_EQ(read_mat().values("on")[19], 1);
  EXPECT_EQ(read_mat().values("coil(:,2)")[1], 3);
}

TEST_F(LoadMat, UnitsThatTheFileHoldsAreThoseOfItsColumns) {
  const std::string change = "c = columns(); c['tau_R_MPa'] *= 1000\n";
  const std::string units = "dict(time_s='s', sigma_n_MPa='MPa', tau_R_MPa='kPa', "
                            "v_rel_mm_s='mm/s')";
  for (const std::string& how :
       {"save(units=" + units + ", **c)", "v73(units=" + units + ", **c)",
        "save(rig=dict(c, units=" + units + "))", std::string("save(tau_R_MPa_unit='kPa', **c)")}) {
    write(change + how);
    EXPECT_DOUBLE_EQ(read_mat().values("tau_R_MPa")[19], 90) << how;
  }
  write(change + "save(**c)");
  EXPECT_DOUBLE_EQ(read_mat().values("tau_R_MPa")[19], 90000) << "not guessed";
}

TEST_F(LoadMat, NamesOfAMatrixAreThoseOfItsColumns) {
  write("c = columns()\nsave(data=numpy.column_stack(list(c.values())), "
        "names=numpy.array(list(c), dtype=object))");
  EXPECT_DOUBLE_EQ(read_mat().values("sigma_n_MPa")[19], 900);
  EXPECT_THAT(read_mat().notes, Contains("columns of 'data' have the names in 'names'"));
}

TEST_F(LoadMat, WhatIsNotReadIsNamedWithAWayOut) {
  write("save(**columns(), z=numpy.arange(20)*1j, cube=numpy.zeros((2, 3, 4)))");
  EXPECT_THAT(read_mat().notes,
              Contains("MATLAB content that is not read: 'cube' (2 x 3 x 4 values), 'z' (complex "
                       "numbers)"));
  write("v73()\nwith h5py.File('a.mat', 'r+') as f:\n  d = f.create_dataset('T', data=[[1, 2]])\n"
        "  d.attrs['MATLAB_class'] = numpy.bytes_('table'); d.attrs['MATLAB_object_decode'] = 3");
  EXPECT_THAT(mat_fault(), HasSubstr("writetable(T, \"test.csv\")"));
}

TEST_F(LoadMat, DamagedFilesAreFaults) {
  write("save(**columns())");
  const std::string whole = io::read_file(directory_ / "a.mat");
  for (const std::size_t size : {130ul, 200ul, whole.size() - 1})
    EXPECT_NE(fault_of({file("b.mat", whole.substr(0, size))}), "no fault") << size;
  std::string flipped = whole;
  flipped[whole.size() - 3] = static_cast<char>(flipped[whole.size() - 3] ^ 1); // a checksum
  EXPECT_THAT(fault_of({file("b.mat", flipped)}), HasSubstr("b.mat: error: cannot be read as a "
                                                            "MATLAB file: the compressed variable "
                                                            "at byte"));
}

class LoadTdms : public test::LoadCase {
protected:
  static test::TdmsSegment& add(test::TdmsSegment& segment, const std::string& group) {
    const std::string path = "/'" + group + "'/'";
    segment.channel(path + "Druck'", 10, 3).property("unit_string", "kPa");
    segment.property("wf_increment", 0.5);
    segment.channel(path + "tau_R_MPa'", 10, 3).property("wf_increment", 0.5);
    return segment.values<double>({5000, 6000, 7000, 0.5, 0.6, 0.7});
  }
};

TEST_F(LoadTdms, OneGroupIsTheFileSeveralAreATestEach) {
  options.columns["sigma_n_MPa"].names = {"Druck"};
  options.columns["time_s"].names = {"time"};
  test::TdmsSegment one;
  const Dataset single = load_dataset({file("a.tdms", add(one, "Log").bytes())}, options);
  EXPECT_THAT(single.experiments, ElementsAre("a"));
  EXPECT_THAT(column(single, "sigma_n_MPa"), ElementsAre(5, 6, 7));
  EXPECT_THAT(column(single, "time_s"), ElementsAre(0, 0.5, 1));
  test::TdmsSegment first, second, other;
  other.channel("/'rig'/'gauge'", 10, 2).values<double>({1, 2});
  const std::string bytes = add(first, "T1").bytes() + add(second, "T2").bytes() + other.bytes();
  const Dataset two = load_dataset({file("b.tdms", bytes)}, options);
  EXPECT_THAT(two.experiments, ElementsAre("T1", "T2"));
  EXPECT_THAT(two.notes, Contains(HasSubstr("'rig' (a group without columns of the job)")));
}

TEST_F(LoadTdms, AGuessKnowsItsUnitsAndTime) {
  test::TdmsSegment segment;
  file("a.tdms", add(segment, "Log").bytes());
  const auto guess = guess::guess_file((directory_ / "a.tdms").string(), "a.tdms").front();
  ASSERT_TRUE(guess.find("sigma_n_MPa"));
  EXPECT_EQ(guess.find("sigma_n_MPa")->unit, "kPa");
  EXPECT_TRUE(guess.find("time_s"));
}

} // namespace
} // namespace frictab::load_mat_test
