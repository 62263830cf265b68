// HDF5 files whose values lie in other files are refused by name; nothing of those is read.
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "core/error.h"
#include "io/file_streams.h"
#include "io/hdf5.h"
#include "io/mat.h"
#include "support/run_command.h"

namespace frictab::hdf5_elsewhere_test {
namespace {

using testing::HasSubstr;

class Hdf5Elsewhere : public testing::Test {
protected:
  // An HDF5 file with a dataset `here` of its own and what `add` makes.
  std::string make(const std::function<void(hid_t file)>& add, const std::string& name = "a.h5") {
    const std::string path = directory.path(name);
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    dataset(file, "here", H5P_DEFAULT);
    add(file);
    H5Fclose(file);
    return path;
  }

  static void dataset(hid_t place, const char* name, hid_t list) {
    const hsize_t size = 8;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t set =
        H5Dcreate2(place, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    ASSERT_GE(set, 0);
    H5Dclose(set);
    H5Sclose(space);
  }

  static void external(hid_t place, const std::string& target) {
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(list, target.c_str(), 0, 64);
    dataset(place, "there", list);
    H5Pclose(list);
  }

  static std::string refusal(const std::function<void()>& read) {
    try {
      read();
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  static std::string refused(const std::string& path) {
    return refusal([&] { io::Hdf5Reader(path, "a.h5"); });
  }

  test::TemporaryDirectory directory;
};

TEST_F(Hdf5Elsewhere, ExternalStorageIsRefusedAndNamed) {
  const std::string said = refused(make([](hid_t file) { external(file, "/etc/passwd"); }));
  EXPECT_THAT(said, HasSubstr("a.h5: error: the values of 'there' lie in another file, "
                              "/etc/passwd, which is not read\n  hint: "));
}

TEST_F(Hdf5Elsewhere, APipeAsExternalStorageIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(directory.path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(refused(make([&](hid_t file) { external(file, directory.path("pipe")); })),
              HasSubstr("lie in another file"));
}

TEST_F(Hdf5Elsewhere, AVirtualDatasetIsRefused) {
  const std::string said = refused(make([](hid_t file) {
    const hsize_t size = 8;
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, &size, nullptr);
    H5Pset_virtual(list, space, "gone.h5", "tau", space);
    dataset(file, "there", list);
    H5Sclose(space);
    H5Pclose(list);
  }));
  EXPECT_THAT(said, HasSubstr("'there' is a virtual dataset: its values lie in other files"));
}

TEST_F(Hdf5Elsewhere, AnExternalLinkIsRefusedHoweverDeepItLies) {
  make([](hid_t) {}, "other.h5");
  const std::string said = refused(make([&](hid_t file) {
    const hid_t group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                inner = H5Gcreate2(group, "inner", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external(directory.path("other.h5").c_str(), "here", inner, "out", H5P_DEFAULT,
                       H5P_DEFAULT);
    H5Lcreate_soft("/g/inner/out", file, "there", H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(inner);
    H5Gclose(group);
  }));
  EXPECT_THAT(said, HasSubstr("'g/inner/out' is a link into another file, "));
  EXPECT_THAT(said, HasSubstr("other.h5, which is not read"));
}

TEST_F(Hdf5Elsewhere, ASoftLinkWithinTheFileIsFollowed) {
  const std::string path =
      make([](hid_t file) { H5Lcreate_soft("/here", file, "there", H5P_DEFAULT, H5P_DEFAULT); });
  EXPECT_EQ(io::Hdf5Reader(path, "a.h5").values("there").size(), 8u);
}

TEST_F(Hdf5Elsewhere, GroupsThatHoldEachOtherEnd) {
  const std::string path = make([](hid_t file) {
    const hid_t group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(file, "/", group, "root", H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(group);
  });
  EXPECT_EQ(refused(path), "");
}

TEST_F(Hdf5Elsewhere, HoldsForMatlabFilesAsWell) {
  const std::string path = make([](hid_t file) { external(file, "/etc/passwd"); }, "a.mat");
  EXPECT_THAT(refusal([&] { io::read_mat(path, "a.mat"); }),
              HasSubstr("the values of 'there' lie in another file, /etc/passwd"));
}

TEST_F(Hdf5Elsewhere, APipeThatIsNamedAsDataIsRefused) {
  ASSERT_EQ(::mkfifo(directory.path("pipe.h5").c_str(), 0600), 0);
  EXPECT_THAT(refused(directory.path("pipe.h5")), HasSubstr("is a pipe or a device"));
}

} // namespace
} // namespace frictab::hdf5_elsewhere_test
