// Formulas that a job is proposed with where files give what a person would compute from.
#include <gmock/gmock.h>

#include "guess/guess.h"
#include "job/guessed_job.h"
#include "job/job.h"
#include "support/run_command.h"

namespace frictab::proposed_formulas_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ProposedFormulas : public testing::Test {
protected:
  // Three recordings with the same lines above five rows of cells.
  void write_tests(const std::string& above, const std::string& header, const std::string& row) {
    for (const char* const name : {"a1.csv", "a2.csv", "a3.csv"}) {
      std::string text = above + "Time (s)," + header + "\n";
      for (const char* const time : {"0", "0.1", "0.2", "0.3", "0.4"})
        text += time + ("," + row) + "\n";
      write(name, text);
    }
  }
  void write(const std::string& name, const std::string& text) {
    directory.write(name, text);
    files.push_back(name);
  }

  // The job for all files, which is valid.
  std::string job() const {
    std::vector<guess::File> guesses;
    for (const std::string& file : files)
      for (guess::File& guess : guess::guess_file(directory.path(file), file))
        guesses.push_back(std::move(guess));
    const guess::Campaign campaign = guess::sort_guesses(std::move(guesses));
    std::vector<std::string> names;
    for (const guess::File& file : campaign.files)
      names.push_back(file.file);
    const std::string text = job::guessed_job(campaign, guess::guess_names(names), names).text;
    directory.write("job.toml", text);
    EXPECT_NO_THROW(job::read_job(directory.path("job.toml"))) << text;
    return text;
  }

  test::TemporaryDirectory directory;
  std::vector<std::string> files;
};

TEST_F(ProposedFormulas, RotationTakesTheRadiusOfATrackFromTheRowsOrThePlan) {
  write_tests("", "Speed (rpm),COF,Pressure (MPa)", "60,0.1,5");
  write("plan.csv", "Test,Track radius (cm)\na1,1.5\na2,2\na3,2.5\n");
  EXPECT_THAT(job(), AllOf(HasSubstr("\nv_rel_mm_s = { formula = \"Speed*2*pi/60*10*Track_radius\" "
                                     "} # a rotation at the radius by Track radius (cm)\n"),
                           Not(HasSubstr("At which radius"))));
}

TEST_F(ProposedFormulas, RotationAndTorqueTakeHalfTheDiameterOfARingAboveTheRows) {
  write_tests("Ring diameter: 35 mm\nRing speed: 200 1/min\n\n", "Torque (Nm),Load (N)", "0.2,100");
  EXPECT_THAT(
      job(), AllOf(HasSubstr("\nv_rel_mm_s = { formula = \"Ring_speed*2*pi/60*Ring_diameter/2\" }"),
                   HasSubstr("\nF_R_N = { formula = \"Torque/(Ring_diameter/2000)\" }")));
}

TEST_F(ProposedFormulas, LoadInKilogramsIsTheWeightOfAMass) {
  write_tests("", "Load (kg),COF", "2.5,0.1");
  EXPECT_THAT(job(), AllOf(HasSubstr("\nF_N_N = { column = \"Load\", unit = \"kgf\" }"),
                           HasSubstr("the weight of a mass in kg, as the file says\n"),
                           HasSubstr("area_mm2 = 78.5, unit = \"kgf\" }")));
}

TEST_F(ProposedFormulas, VoltageOfFrictionTakesTheFactorAboveTheRows) {
  write_tests("Friction force calibration factor: 4.87 N/mV\n\n", "Friction (mV),Load (N)",
              "1.2,20");
  EXPECT_THAT(
      job(),
      HasSubstr("\n# ? Is friction Friction (mV) times Friction force calibration factor? It "
                "is a voltage.\n# F_R_N = { formula = "
                "\"Friction*Friction_force_calibration_factor\" }"));
}

TEST_F(ProposedFormulas, VoltageOfFrictionInMillivoltsIsScaledToAFactorPerVolt) {
  write_tests("", "Friction (mV),Load (N),Calibration (N/V)", "1.2,20,4870");
  EXPECT_THAT(job(), HasSubstr("# F_R_N = { formula = \"0.001*Friction*Calibration\" }"));
}

TEST_F(ProposedFormulas, StrokesGiveAMeanSpeed) {
  write_tests("Stroke: 1.00 mm\nFrequency: 50 Hz\n\n", "COF,Pressure (MPa)", "0.1,5");
  EXPECT_THAT(job(),
              HasSubstr("\n# ? How fast does it slide? No column is a speed, but others give "
                        "one.\n# v_rel_mm_s = { formula = \"2*Stroke*Frequency\" }"));
}

TEST_F(ProposedFormulas, PositionGivesASpeedBySlopes) {
  write_tests("", "COF,Pressure (MPa),Sled position (mm)", "0.1,5,3");
  EXPECT_THAT(job(), HasSubstr("\n# v_rel_mm_s = { column = \"Sled position\", slope_rows = 5 }"));
}

TEST_F(ProposedFormulas, DiameterOfAPinGivesTheArea) {
  write_tests("", "COF,Load (N)", "0.1,20");
  write("plan.csv", "Test,Pin diameter (mm)\na1,4\na2,6\na3,6\n");
  EXPECT_THAT(job(), HasSubstr("\n# ? Where does the contact normal stress come from? None was "
                               "found.\n# sigma_n_MPa = { formula = "
                               "\"F_N_N/(pi/4*Pin_diameter**2)\" }"));
}

TEST_F(ProposedFormulas, BallHasNoConstantArea) {
  write_tests("Ball diameter: 10 mm\n\n", "COF,Load (N)", "0.1,20");
  EXPECT_THAT(job(), AllOf(HasSubstr("(3*F_N_N*Ball_diameter/2/(4*115385))**(2/3))\" }"),
                           HasSubstr("# a ball has no constant area: "), Not(HasSubstr("pi/4"))));
}

TEST_F(ProposedFormulas, ForceAndTorqueAreBothShown) {
  write_tests("", "Torque (Nm),Tangential force (N),Load (N)", "0.2,12,100");
  EXPECT_THAT(job(), HasSubstr("\n# ? Is Torque (Nm) the better reading of friction? Tangential "
                               "force (N) is taken.\n# F_R_N = { formula = \"Torque/RADIUS_M\" }"));
}

TEST_F(ProposedFormulas, FrictionOfTheHeadGoesBeforeATotalTorque) {
  write_tests("", "Gesamtmoment [Nm],Gewindemoment [Nm],Kopfreibmoment [Nm],Vorspannkraft [kN]",
              "20,12,8,9");
  EXPECT_THAT(job(), HasSubstr("Kopfreibmoment [Nm] is a torque, in Nm. Others are Gesamtmoment "
                               "[Nm] or Gewindemoment [Nm].\n# F_R_N = { formula = "
                               "\"Kopfreibmoment/RADIUS_M\" }"));
}

TEST_F(ProposedFormulas, SurfaceEnlargementBelowAHundredPercentIsAnIncrease) {
  write_tests("", "COF,Pressure (MPa),Surface enlargement [%]", "0.1,500,12");
  EXPECT_THAT(job(), HasSubstr("\npsi = { formula = \"1 + Surface_enlargement/100\" }"));
  files.clear();
  write_tests("", "COF,Pressure (MPa),Surface enlargement [%]", "0.1,500,130");
  EXPECT_THAT(job(), AllOf(HasSubstr("\npsi = \"Surface enlargement\""),
                           HasSubstr("\n# psi = { formula = \"1 + Surface_enlargement/100\" }")));
}

TEST_F(ProposedFormulas, GroupsOfNamesDoNotRepeatColumnsOfThePlan) {
  for (const char* const name : {"B7_20260302.csv", "B8_20260303.csv", "B9_20260304.csv"})
    write(name, "Time (s),COF,Pressure (MPa)\n0,0.1,5\n1,0.1,5\n2,0.1,5\n");
  write("plan.csv", "File,date,Oil age [h]\nB7_20260302.csv,2.3.2026,2\n"
                    "B8_20260303.csv,3.3.2026,10\nB9_20260304.csv,4.3.2026,18\n");
  EXPECT_THAT(job(), AllOf(HasSubstr("\ntests = \"plan.csv\""), Not(HasSubstr("from_name"))));
}

TEST_F(ProposedFormulas, PlanOfFewTestsAboveALegendIsFound) {
  write_tests("", "COF,Pressure (MPa)", "0.1,5");
  write("plan.csv", "Test,Oil,Age (h)\na1,A,2\na2,B,10\na3,B,18\n\nLegend\nA,mineral\nB,rape\n");
  EXPECT_THAT(job(), HasSubstr("\ntests = \"plan.csv\""));
}

TEST_F(ProposedFormulas, TableOfTestsIsFoundByTheNamesOfFiles) {
  write_tests("", "COF,Pressure (MPa)", "0.1,5");
  write("list.csv",
        "Date,Datei,Oil age [h]\n02.03.2026 09:00,a1.csv,2\n03.03.2026 09:00,a2.csv,10\n"
        "04.03.2026 09:00,a3.csv,18\n");
  EXPECT_THAT(job(), AllOf(HasSubstr("\ntests = \"list.csv\""),
                           HasSubstr("\nexperiment = \"Datei\""), Not(HasSubstr("not read"))));
}

} // namespace
} // namespace frictab::proposed_formulas_test
