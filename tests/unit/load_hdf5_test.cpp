// HDF5 files as h5py, MATLAB and rigs write them: what is read, and that the rest is told.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "data/load_condensed.h"
#include "support/run_command.h"
#include "unit/load_case.h"

namespace frictab::load_hdf5_test {

using data::Dataset;
using data::load_dataset;

namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Values = std::vector<double>;

// `rows` writes columns of two tests into the file f, `tests` groups of them; SYNTHETIC.
constexpr const char* head = R"(
import h5py, numpy
def columns(first, rows=20):
  p = numpy.linspace(500, 900, rows) + first
  return dict(time_s=numpy.arange(rows)*0.1, sigma_n_MPa=p, tau_R_MPa=0.1*p, v_rel_mm_s=numpy.full(rows, 5.0))
def rows(f, shape=(-1,), rows=20):
  for name, values in columns(0, 2*rows).items(): f[name] = values.reshape(shape)
  f["experiment"] = numpy.repeat([1, 2], rows).reshape(shape)
def tests(f, count=2):
  for test in range(count):
    for name, values in columns(test).items(): f[f"t{test}/{name}"] = values
with h5py.File("a.h5", "w") as f:
)";

class LoadHdf5 : public test::LoadCase {
protected:
  // Statements that fill the file, one a line.
  void write(std::string statements) {
    for (std::size_t at = 0; (at = statements.find('\n', at)) != statements.npos; at += 3)
      statements.insert(at + 1, "  ");
    const auto [code, out, err] =
        test::run_command({FRICTAB_PYTHON, "-c", head + ("  " + statements)}, directory_);
    ASSERT_EQ(code, 0) << err;
  }
  Dataset read_hdf5() { return load_dataset({"a.h5"}, options); }
  std::string hdf5_fault() { return fault_of({"a.h5"}); }
  // In pieces of one row, or of one test.
  Dataset in_pieces() {
    options.piece_bytes = 1;
    return data::load_condensed({"a.h5"}, options, 10);
  }
  std::string fault_in_pieces() {
    try {
      in_pieces();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
};

TEST_F(LoadHdf5, AttributesOfTheFileAreConditionsThatAboveKeeps) {
  write("rows(f)\nf.attrs['Oil'] = 'PAO 4'");
  EXPECT_EQ(read_hdf5().find("Oil"), nullptr);
  options.above = {"Oil"};
  ASSERT_NE(read_hdf5().find("Oil"), nullptr);
  EXPECT_THAT(read_hdf5().find("Oil")->levels, ElementsAre("PAO 4"));
  options.above = {"Oli"};
  EXPECT_THAT(hdf5_fault(), HasSubstr("no value of the whole file is called 'Oli' (data.above)"));
}

TEST_F(LoadHdf5, ColumnsOfTwoAxesAreReadAsMatlabWritesThem) {
  write("rows(f)");
  const Dataset flat = read_hdf5();
  for (const char* shape : {"(-1, 1)", "(1, -1)"}) {
    write(fmt::format("rows(f, {})", shape));
    const Dataset data = read_hdf5();
    EXPECT_EQ(data.hash, flat.hash) << shape;
    EXPECT_THAT(data.notes, Not(Contains(HasSubstr("not read")))) << shape;
    EXPECT_EQ(in_pieces().experiments, flat.experiments) << shape;
    EXPECT_EQ(in_pieces().source_rows(), flat.rows()) << shape;
  }
  write("rows(f)\nf['sigma_f_MPa'] = numpy.full((40, 1), 400.0)\n"
        "f['oil'] = numpy.array([[b'a'] * 40])");
  EXPECT_THAT(column(read_hdf5(), "sigma_f_MPa"), Each(400));
  EXPECT_THAT(read_hdf5().find("oil")->levels, ElementsAre("a"));
  EXPECT_THAT(column(in_pieces(), "sigma_f_MPa"), Each(400));
}

TEST_F(LoadHdf5, ALargeColumnOfTwoAxesIsReadInSlices) {
  write("rows(f, (-1, 1), 1100000)"); // more than 16 MiB each
  const Dataset data = read_hdf5();
  ASSERT_EQ(data.rows(), 2'200'000u);
  EXPECT_DOUBLE_EQ(data.values("sigma_n_MPa")[0], 500);
  EXPECT_DOUBLE_EQ(data.values("sigma_n_MPa")[2'199'999], 900);
}

TEST_F(LoadHdf5, TestsAreReadWhereTheRootHoldsNoColumnOfThem) {
  write("tests(f)\nf['calibration_curve'] = numpy.arange(7.0)\nf['table'] = numpy.zeros((3, 4))");
  const Dataset data = read_hdf5();
  EXPECT_THAT(data.experiments, ElementsAre("t0", "t1"));
  const std::string note =
      "HDF5 content that is not read: 'calibration_curve' (7 values), 'table' (3 x 4 values)";
  EXPECT_THAT(data.notes, Contains(note));
  EXPECT_THAT(in_pieces().notes, Contains(note));
  EXPECT_THAT(in_pieces().experiments, data.experiments);
}

TEST_F(LoadHdf5, TestsBesideColumnsOfRowsAreAnError) {
  write("rows(f)\ntests(f)");
  const std::string told = "a.h5: error: holds the column 'experiment' and groups with columns "
                           "('t0/sigma_n_MPa'): either could be the campaign";
  EXPECT_THAT(hdf5_fault(), HasSubstr(told));
  EXPECT_THAT(fault_in_pieces(), HasSubstr(told));
  write("tests(f)\nf['psi'] = numpy.arange(40.0)");
  EXPECT_THAT(hdf5_fault(), HasSubstr("holds the column 'psi' and groups"));
}

TEST_F(LoadHdf5, GroupsBesideColumnsAreTold) {
  write("rows(f)\nf['rig/gauge'] = numpy.arange(7.0)\nf['log'] = h5py.SoftLink('/nowhere')");
  const std::string note =
      "HDF5 content that is not read: 'log' (a link to nothing), 'rig' (a group)";
  EXPECT_THAT(read_hdf5().notes, Contains(note));
  EXPECT_THAT(in_pieces().notes, Contains(note));
}

TEST_F(LoadHdf5, SingleValuesOfTheFileAreReadWhereTheyAreQuantitiesAndElseTold) {
  write("rows(f)\nf['sigma_f_MPa'] = 400.0\nf['comment'] = 'first try'\nf.attrs['title'] = 'x'");
  EXPECT_THAT(column(read_hdf5(), "sigma_f_MPa"), Each(400));
  const std::string note =
      "HDF5 content that is not read: 'title' (an attribute), 'comment' (a single value)";
  EXPECT_THAT(read_hdf5().notes, Contains(note));
  EXPECT_THAT(in_pieces().notes, Contains(note));
  EXPECT_THAT(column(in_pieces(), "sigma_f_MPa"), Each(400));
  write("tests(f)\nf.attrs['sigma_f_MPa'] = 400.0\nf['T_tool_C'] = [[20.0]]");
  EXPECT_THAT(column(read_hdf5(), "sigma_f_MPa"), Each(400));
  EXPECT_THAT(column(in_pieces(), "T_tool_C"), Each(20));
  write("rows(f)\nf['kf'] = 0.4\nf['kf'].attrs['units'] = 'GPa'");
  options.columns["sigma_f_MPa"].names = {"kf"};
  EXPECT_THAT(column(read_hdf5(), "sigma_f_MPa"), Each(400));
}

TEST_F(LoadHdf5, AValueOfTheFileBesideColumnsOfItsNameIsTold) {
  write("rows(f)\nf.attrs['v_rel_mm_s'] = 7.0");
  EXPECT_THAT(read_hdf5().notes, Contains("HDF5 content that is not read: 'v_rel_mm_s' (an "
                                          "attribute, in addition to columns of that name)"));
  EXPECT_THAT(column(read_hdf5(), "v_rel_mm_s"), Each(5));
}

TEST_F(LoadHdf5, SingleValuesOfATestAreColumnsAsItsAttributesAre) {
  write("tests(f)\n"
        "for t in (0, 1): f[f't{t}/film_um'] = 0.5*t; f[f't{t}/oil'] = 'ab'[t]");
  const Dataset data = read_hdf5();
  EXPECT_EQ(data.values("film_um")[39], 0.5);
  EXPECT_THAT(data.find("oil")->levels, ElementsAre("a", "b"));
  EXPECT_EQ(in_pieces().values("film_um").back(), 0.5);
}

TEST_F(LoadHdf5, ASingleValueOfSomeTestsIsToldAndHindersNothing) {
  write("tests(f, 3)\nf['t1/comment'] = 'odd'\nf['t2/none'] = h5py.Empty('f')");
  const std::string note =
      "HDF5 content that is not read: 't1/comment' (a single value, not in all "
      "tests), 't2/none' (no value)";
  EXPECT_THAT(read_hdf5().notes, Contains(note));
  EXPECT_THAT(in_pieces().notes, Contains(note));
}

TEST_F(LoadHdf5, WhatATestHoldsBesidesIsToldOnceWithItsCount) {
  write("tests(f, 3)\n"
        "for t in (0, 1, 2): f[f't{t}'].attrs['gains'] = [1.0, 2.0]; f[f't{t}/raw/x'] = 1.0\n"
        "f['t1/image'] = numpy.zeros((3, 4))\nf.create_group('log')");
  const std::string note =
      "HDF5 content that is not read: 'log' (a group without columns), 'gains' (an attribute of 2 "
      "values) in 3 groups, 'raw' (a group within a group) in 3 groups, "
      "'t1/image' (3 x 4 values)";
  EXPECT_THAT(read_hdf5().notes, Contains(note));
  EXPECT_THAT(in_pieces().notes, Contains(note));
}

TEST_F(LoadHdf5, WhatIsAskedForAndNoColumnIsAnError) {
  write("rows(f)\nf['sigma_f_MPa'] = numpy.zeros((40, 2))");
  EXPECT_THAT(hdf5_fault(),
              HasSubstr("a.h5: error: 'sigma_f_MPa' is not a column: it is 40 x 2 values"));
  EXPECT_THAT(fault_in_pieces(), HasSubstr("'sigma_f_MPa' is not a column: it is 40 x 2 values"));
  options.constants["sigma_f_MPa"] = 400; // nobody asks for the file's own
  EXPECT_THAT(read_hdf5().notes,
              Contains("HDF5 content that is not read: 'sigma_f_MPa' (40 x 2 values)"));
}

TEST_F(LoadHdf5, OfAFileWithoutColumnsTheErrorSaysWhatIsThere) {
  write("f['data'] = numpy.zeros((40, 5))\nf['rig/tests/t0/time_s'] = numpy.arange(9.0)");
  EXPECT_THAT(hdf5_fault(), HasSubstr("a.h5: error: holds no data columns"));
  EXPECT_THAT(hdf5_fault(),
              HasSubstr("it holds 'rig' (a group without columns), 'data' (40 x 5 values)"));
}

TEST_F(LoadHdf5, WhatFrictabWritesHoldsNothingThatIsNotRead) {
  write("rows(f)\nf.attrs['source'] = 'frictab'");
  EXPECT_THAT(read_hdf5().notes, Not(Contains(HasSubstr("not read"))));
}

TEST_F(LoadHdf5, AFilterThatIsMissingIsNamedAndIsNoDamage) {
  write("for name, values in columns(0).items(): "
        "f.create_dataset(name, data=values, compression='lzf')");
  const std::string told = "'sigma_n_MPa' cannot be read: it is compressed by the filter lzf, "
                           "which the HDF5 library here does not have";
  EXPECT_THAT(hdf5_fault(), HasSubstr(told));
  EXPECT_THAT(hdf5_fault(), HasSubstr("h5repack -f GZIP=4"));
  EXPECT_THAT(hdf5_fault(), Not(HasSubstr("damaged")));
  EXPECT_THAT(fault_in_pieces(), HasSubstr(told));
}

TEST_F(LoadHdf5, BooleansAreZeroAndOne) {
  write(
      "rows(f)\nf['oiled'] = numpy.arange(40) >= 20\nf['dry'] = (numpy.arange(40) < 20)[:, None]");
  Values oiled(40, 0);
  std::fill(oiled.begin() + 20, oiled.end(), 1.0);
  EXPECT_EQ(column(read_hdf5(), "oiled"), oiled);
  EXPECT_EQ(read_hdf5().values("dry")[0], 1);
  EXPECT_EQ(in_pieces().values("oiled").front(), 0);
  EXPECT_EQ(in_pieces().values("oiled").back(), 1);
  write("tests(f)\nfor t in (0, 1): f[f't{t}'].attrs['oiled'] = bool(t)");
  EXPECT_EQ(read_hdf5().values("oiled")[0], 0);
  EXPECT_EQ(read_hdf5().values("oiled")[39], 1);
}

TEST_F(LoadHdf5, ColumnsOfOtherTypesAreLeftOutAndTold) {
  write("rows(f)\nf['z'] = numpy.arange(40) + 1j\n"
        "f.create_dataset('wave', (40,), dtype=h5py.vlen_dtype('f8'))\n"
        "f.create_dataset('oil', (40,), dtype=h5py.enum_dtype({'A': 0, 'B': 1}, basetype='i1'))");
  const std::string note = "HDF5 content that is not read: 'oil' (an enumeration), 'wave' (lists), "
                           "'z' (records of r, i)";
  EXPECT_THAT(read_hdf5().notes, Contains(note));
  EXPECT_FALSE(read_hdf5().has("z"));
  EXPECT_THAT(in_pieces().notes, Contains(note));
}

TEST_F(LoadHdf5, AColumnOfAnotherTypeThatIsAskedForIsAnError) {
  write("rows(f)\nf['z'] = numpy.arange(40) + 1j");
  options.columns["sigma_f_MPa"].names = {"z"};
  const std::string told = "a.h5: error: 'z' is not a column: it is records of r, i";
  EXPECT_THAT(hdf5_fault(), HasSubstr(told));
  EXPECT_THAT(hdf5_fault(), HasSubstr("a column has a number or a text per row"));
  EXPECT_THAT(fault_in_pieces(), HasSubstr(told));
}

} // namespace
} // namespace frictab::load_hdf5_test
