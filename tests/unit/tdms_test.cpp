// TDMS files of every form that the format's description allows, written byte by byte.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/random.h"
#include "io/tdms.h"
#include "support/tdms_bytes.h"

namespace frictab::tdms_test {
namespace {

namespace fs = std::filesystem;

using test::TdmsSegment;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t i8 = 1, i16 = 2, i32 = 3, i64 = 4, u8 = 5, u16 = 6, u32 = 7, u64 = 8,
                        single = 9, real = 10, text = 0x20, boolean = 0x21, stamp = 0x44;
constexpr const char *a = "/'G'/'a'", *b = "/'G'/'b'";

class Tdms : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    file_ = fs::path(testing::TempDir()) / (std::string("frictab_tdms_") + test->name() + ".tdms");
  }
  void TearDown() override { fs::remove(file_); }

  io::ColumnGroups read(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary) << bytes;
    return io::read_tdms(file_, "a.tdms");
  }
  std::string fault(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  static const io::GroupMember& member(const io::ColumnGroups& all, const std::string& name,
                                       std::size_t group = 0) {
    for (const io::GroupMember& one : all.groups.at(group).members)
      if (one.name == name) return one;
    throw std::runtime_error("there is no " + name);
  }
  std::vector<double> numbers(const std::string& bytes, const std::string& name = "a") {
    return member(read(bytes), name).numbers;
  }

  fs::path file_;
};

template <class T>
std::vector<double> values_of_type(std::uint32_t type, const std::vector<T>& values, bool big,
                                   const fs::path& file) {
  const std::string bytes = TdmsSegment(big).channel(a, type, values.size()).values(values).bytes();
  std::ofstream(file, std::ios::binary) << bytes;
  return io::read_tdms(file, "a.tdms").groups.front().members.front().numbers;
}

TEST_F(Tdms, NumbersOfEveryTypeAreReadInBothByteOrders) {
  for (const bool big : {false, true}) {
    EXPECT_THAT(values_of_type<std::int8_t>(i8, {-128, 127}, big, file_), ElementsAre(-128, 127));
    EXPECT_THAT(values_of_type<std::int16_t>(i16, {-2, 300}, big, file_), ElementsAre(-2, 300));
    EXPECT_THAT(values_of_type<std::int32_t>(i32, {-2, 70000}, big, file_), ElementsAre(-2, 70000));
    EXPECT_THAT(values_of_type<std::int64_t>(i64, {-2, 1ll << 40}, big, file_),
                ElementsAre(-2, 1099511627776.0));
    EXPECT_THAT(values_of_type<std::uint8_t>(u8, {0, 255}, big, file_), ElementsAre(0, 255));
    EXPECT_THAT(values_of_type<std::uint16_t>(u16, {1, 65535}, big, file_), ElementsAre(1, 65535));
    EXPECT_THAT(values_of_type<std::uint32_t>(u32, {1, 4000000000u}, big, file_),
                ElementsAre(1, 4e9));
    EXPECT_THAT(values_of_type<std::uint64_t>(u64, {1, 1ull << 40}, big, file_),
                ElementsAre(1, 1099511627776.0));
    EXPECT_THAT(values_of_type<float>(single, {0.5f, -3}, big, file_), ElementsAre(0.5, -3));
    EXPECT_THAT(values_of_type<float>(0x19, {0.5f, -3}, big, file_), ElementsAre(0.5, -3));
    EXPECT_THAT(values_of_type<double>(real, {0.1, -3}, big, file_), ElementsAre(0.1, -3));
    EXPECT_THAT(values_of_type<double>(0x1a, {0.1, -3}, big, file_), ElementsAre(0.1, -3));
    EXPECT_THAT(values_of_type<std::uint8_t>(boolean, {0, 1, 7}, big, file_), ElementsAre(0, 1, 1));
  }
}

TEST_F(Tdms, GroupsChannelsUnitsAndPropertiesAreNamed) {
  const io::ColumnGroups all = read(TdmsSegment()
                                        .object("/")
                                        .property("title", "pin on disc")
                                        .object("/'Dr. T''s \xb5'") // Latin-1
                                        .property("load", 20.0)
                                        .property("oiled", boolean, std::string("\1", 1))
                                        .channel("/'Dr. T''s \xb5'/'F/N'", real, 2)
                                        .property("unit_string", "N")
                                        .values<double>({1, 2})
                                        .bytes());
  EXPECT_EQ(all.root.members.at(0).name, "title");
  EXPECT_EQ(all.root.members.at(0).single, io::NumberOrText("pin on disc"));
  ASSERT_EQ(all.groups.size(), 1u);
  EXPECT_EQ(all.groups[0].name, "Dr. T's µ");
  EXPECT_EQ(member(all, "F/N").unit, "N");
  EXPECT_EQ(member(all, "load").single, io::NumberOrText(20.0));
  EXPECT_EQ(member(all, "oiled").single, io::NumberOrText(1.0));
}

TEST_F(Tdms, TextsAreReadInBothByteOrders) {
  for (const bool big : {false, true}) {
    const auto all =
        read(TdmsSegment(big).channel(a, text, 3, 12 + 7).texts({"oil", "", "dry\xb5"}).bytes());
    EXPECT_THAT(member(all, "a").texts, ElementsAre("oil", "", "dryµ"));
  }
}

TEST_F(Tdms, TimeStampsBecomeSecondsSinceTheFirstAndANoteSaysSo) {
  for (const bool big : {false, true}) {
    TdmsSegment segment(big);
    segment.channel(a, stamp, 3);
    for (const auto& [seconds, fraction] :
         {std::pair(3'800'000'000ll, 1ull << 63), std::pair(3'800'000'001ll, 0ull),
          std::pair(3'800'000'010ll, 3ull << 62)}) {
      if (big) segment.values<std::int64_t>({seconds});
      segment.values<std::uint64_t>({fraction});
      if (!big) segment.values<std::int64_t>({seconds});
    }
    const auto all = read(segment.bytes());
    EXPECT_THAT(member(all, "a").numbers, ElementsAre(0, 0.5, 10.25));
    EXPECT_EQ(member(all, "a").unit, "s");
    EXPECT_THAT(all.notes, ElementsAre("time stamps, read as seconds since the first one: a"));
  }
}

TEST_F(Tdms, ChunksOfASegmentAreReadOneAfterTheOther) {
  const std::string bytes = TdmsSegment()
                                .channel(a, i16, 2)
                                .channel(b, i16, 1)
                                .values<std::int16_t>({1, 2, 10, 3, 4, 20})
                                .bytes();
  EXPECT_THAT(numbers(bytes), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(numbers(bytes, "b"), ElementsAre(10, 20));
}

TEST_F(Tdms, InterleavedValuesAreTakenApart) {
  const std::string bytes = TdmsSegment()
                                .interleaved()
                                .channel(a, i16, 3)
                                .channel(b, u8, 3)
                                .raw(std::string("\1\0\11\2\0\12\3\0\13", 9))
                                .bytes();
  EXPECT_THAT(numbers(bytes), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers(bytes, "b"), ElementsAre(9, 10, 11));
}

TEST_F(Tdms, SegmentsContinueExtendOrReplaceTheListOfChannels) {
  const std::string first =
      TdmsSegment().channel(a, real, 1).channel(b, real, 1).values<double>({1, 10}).bytes();
  const std::string no_list = TdmsSegment().values<double>({2, 20, 3, 30}).bytes();
  const std::string longer = TdmsSegment()
                                 .continued()
                                 .channel(b, real, 2)
                                 .channel("/'G'/'c'", real, 1)
                                 .values<double>({4, 40, 50, 100})
                                 .bytes();
  const std::string only_a = TdmsSegment().same(a).object(b).values<double>({5}).bytes();
  const std::string without_b = TdmsSegment().continued().object(b).values<double>({6}).bytes();
  const std::string all = first + no_list + longer + only_a + without_b;
  EXPECT_THAT(numbers(all), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(numbers(all, "b"), ElementsAre(10, 20, 30, 40, 50));
  EXPECT_THAT(numbers(all, "c"), ElementsAre(100));
}

TEST_F(Tdms, OfAnUnfinishedSegmentWholeChunksAreReadAndTheRestIsCounted) {
  const auto all =
      read(TdmsSegment().unfinished().channel(a, real, 2).values<double>({1, 2, 3, 4, 5}).bytes());
  EXPECT_THAT(member(all, "a").numbers, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(all.notes,
              ElementsAre("the last segment was not finished: its whole chunks are read; 8 bytes "
                          "after them, of a chunk of 16, are lost"));
}

TEST_F(Tdms, LinearAndPolynomialScalesAreApplied) {
  const auto scaled = [&](TdmsSegment segment) {
    return numbers(segment.values<std::int16_t>({0, 1, 2}).bytes());
  };
  const TdmsSegment raw =
      TdmsSegment().channel(a, i16, 3).property("NI_Scaling_Status", "unscaled");
  TdmsSegment linear = raw;
  linear.property("NI_Number_Of_Scales", u32, raw.number(std::uint32_t{1}))
      .property("NI_Scale[0]_Scale_Type", "Linear")
      .property("NI_Scale[0]_Linear_Slope", 2.0)
      .property("NI_Scale[0]_Linear_Y_Intercept", 10.0)
      .property("NI_Scale[0]_Linear_Input_Source", u32, raw.number(std::uint32_t(-1)));
  EXPECT_THAT(scaled(linear), ElementsAre(10, 12, 14));
  TdmsSegment polynomial = raw;
  polynomial.property("NI_Number_Of_Scales", u32, raw.number(std::uint32_t{2}))
      .property("NI_Scale[0]_Scale_Type", "Linear")
      .property("NI_Scale[0]_Linear_Slope", 2.0)
      .property("NI_Scale[0]_Linear_Y_Intercept", 10.0)
      .property("NI_Scale[1]_Scale_Type", "Polynomial")
      .property("NI_Scale[1]_Polynomial_Coefficients_Size", u32, raw.number(std::uint32_t{3}))
      .property("NI_Scale[1]_Polynomial_Coefficients[0]", 1.0)
      .property("NI_Scale[1]_Polynomial_Coefficients[1]", 0.0)
      .property("NI_Scale[1]_Polynomial_Coefficients[2]", 1.0)
      .property("NI_Scale[1]_Polynomial_Input_Source", u32, raw.number(std::uint32_t{0}));
  EXPECT_THAT(scaled(polynomial), ElementsAre(101, 145, 197));
  TdmsSegment done = linear;
  done.property("NI_Scaling_Status", "scaled");
  EXPECT_THAT(scaled(done), ElementsAre(0, 1, 2));
}

TEST_F(Tdms, OtherScalesAreNamedAndTheirChannelIsNotRead) {
  const auto all = read(TdmsSegment()
                            .channel(a, i16, 2)
                            .property("NI_Number_Of_Scales", i32, std::string("\1\0\0\0", 4))
                            .property("NI_Scale[0]_Scale_Type", "Thermocouple")
                            .channel(b, i16, 2)
                            .values<std::int16_t>({1, 2, 3, 4})
                            .bytes());
  EXPECT_THAT(member(all, "a").other_type, HasSubstr("an NI scale of type Thermocouple"));
  EXPECT_THAT(member(all, "b").numbers, ElementsAre(3, 4));
}

TEST_F(Tdms, RawDaqmxDataAreReadFromTheirRows) {
  const auto scale = [](TdmsSegment& segment, double slope) {
    segment.property("NI_Scaling_Status", "unscaled")
        .property("NI_Number_Of_Scales", u32, segment.number(std::uint32_t{2}))
        .property("NI_Scale[1]_Scale_Type", "Linear")
        .property("NI_Scale[1]_Linear_Slope", slope)
        .property("NI_Scale[1]_Linear_Y_Intercept", 0.0)
        .property("NI_Scale[1]_Linear_Input_Source", u32, segment.number(std::uint32_t{0}));
  };
  TdmsSegment segment;
  segment.daqmx(a, 2, 3, 0, 4); // 3: 16 bits with a sign
  scale(segment, 0.5);
  segment.daqmx(b, 2, 3, 2, 4);
  scale(segment, 1);
  segment.values<std::int16_t>({2, -7, 4, -8, 6, -9, 8, -10});
  EXPECT_THAT(numbers(segment.bytes()), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(numbers(segment.bytes(), "b"), ElementsAre(-7, -8, -9, -10));
}

TEST_F(Tdms, AWaveformGivesATimeThatItsChannelsShare) {
  const auto segment = [](double second) {
    return TdmsSegment()
        .channel(a, real, 3)
        .property("wf_increment", 0.5)
        .property("wf_start_offset", 1.0)
        .channel(b, real, 3)
        .property("wf_increment", second)
        .property("wf_start_offset", 1.0)
        .values<double>({1, 2, 3, 4, 5, 6})
        .bytes();
  };
  const auto all = read(segment(0.5));
  EXPECT_THAT(member(all, "time").numbers, ElementsAre(1, 1.5, 2));
  EXPECT_EQ(member(all, "time").unit, "s");
  const auto differ = read(segment(0.25));
  EXPECT_EQ(differ.groups[0].members.size(), 2u);
  EXPECT_THAT(differ.notes, Contains(HasSubstr("'G' differ in wf_increment")));
}

TEST_F(Tdms, AChannelOfTimesTakesPrecedenceOverTheWaveform) {
  const auto all = read(TdmsSegment()
                            .channel("/'G'/'Time'", real, 2)
                            .channel(a, real, 2)
                            .property("wf_increment", 0.5)
                            .values<double>({5, 6, 1, 2})
                            .bytes());
  EXPECT_EQ(all.groups[0].members.size(), 2u);
}

TEST_F(Tdms, AnIndexFileAndTypesOfUnknownSizeAreRefusedByName) {
  std::string index = TdmsSegment().channel(a, real, 1).bytes();
  index[3] = 'h';
  EXPECT_THAT(fault(index), HasSubstr("a.tdms: error: is the index of a TDMS file"));
  EXPECT_THAT(fault(TdmsSegment().channel(a, 0x0b, 1).raw(std::string(16, '\0')).bytes()),
              HasSubstr("the channel 'G'/'a' has extended floating-point numbers"));
  const auto all = read(
      TdmsSegment().channel(a, 0x10000d, 1).channel(b, u8, 1).raw(std::string(17, '\1')).bytes());
  EXPECT_EQ(member(all, "a").other_type, "complex numbers");
  EXPECT_THAT(member(all, "b").numbers, ElementsAre(1));
}

TEST_F(Tdms, LengthsThatTheFileDoesNotHoldAreFaultsWithTheirOffset) {
  const std::string huge =
      TdmsSegment().channel(a, real, std::uint64_t{1} << 60).values<double>({1}).bytes();
  EXPECT_THAT(fault(huge), HasSubstr("8 bytes of raw data are left, a chunk has"));
  std::string many = TdmsSegment().channel(a, real, 1).values<double>({1}).bytes();
  many.replace(28, 4, "\xff\xff\xff\x7f");
  EXPECT_THAT(fault(many), HasSubstr("is damaged at byte 28: it lists 2,147,483,647 entries"));
  std::string cut = TdmsSegment().channel(a, real, 1).values<double>({1}).bytes();
  cut.pop_back();
  EXPECT_THAT(fault(cut), HasSubstr("the file ends after"));
  EXPECT_THAT(fault(TdmsSegment().channel(a, text, 1, 6).raw("\x09\0\0\0ab").bytes()),
              HasSubstr("damaged at byte"));
}

std::string sample() {
  return TdmsSegment()
             .object("/'G'")
             .property("load", 20.0)
             .channel(a, real, 2)
             .property("unit_string", "N")
             .channel("/'G'/'oil'", text, 2, 10)
             .values<double>({1, 2})
             .texts({"a", "b"})
             .bytes() +
         TdmsSegment()
             .interleaved()
             .channel(a, real, 1)
             .channel(b, i16, 1)
             .raw(std::string(10, '\0'))
             .bytes();
}

TEST_F(Tdms, EveryTruncationGivesAFaultOrWholeSegments) {
  const std::string bytes = sample();
  const std::size_t first = bytes.find("TDSm", 4);
  for (std::size_t size = 4; size < bytes.size(); ++size) {
    const std::string found = fault(bytes.substr(0, size));
    EXPECT_EQ(found == "no fault", size == first) << size << ": " << found;
  }
}

TEST_F(Tdms, DamagedBytesGiveAFaultOrColumns) {
  const std::string bytes = sample();
  Random random(5);
  std::size_t refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string damaged = bytes;
    for (std::size_t k = 1 + random.below(4); k > 0; --k)
      damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    refused += fault(damaged) != "no fault";
  }
  EXPECT_GT(refused, 1000u);
}

} // namespace
} // namespace frictab::tdms_test
