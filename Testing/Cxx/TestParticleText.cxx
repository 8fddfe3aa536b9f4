// SPDX-License-Identifier: BSD-3-Clause
/// Particles in text: LAMMPS dumps and XYZ, whole, packed, broken.

#include "VTKErrors.h"
#include "vtkParticleTextReader.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtk_zlib.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace
{
class ParticleText : public testing::Test
{
protected:
  /// A file of that content, which goes away after the test.
  std::string fileOf(const std::string& name, const std::string& text)
  {
    const std::string path = testing::TempDir() + "particle-text-" + name;
    if (name.size() > 3 && name.substr(name.size() - 3) == ".gz")
    {
      const gzFile file = gzopen(path.c_str(), "wb");
      gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
      gzclose(file);
    }
    else
    {
      std::ofstream(path, std::ios::binary) << text;
    }
    files_.push_back(path);
    return path;
  }

  void TearDown() override
  {
    for (const std::string& file : files_)
    {
      std::remove(file.c_str());
    }
  }

  vtkPolyData* read(double time = -1)
  {
    errors_ = std::make_unique<ErrorCatcher>(reader_);
    if (time < 0)
    {
      reader_->Update();
    }
    else
    {
      reader_->UpdateTimeStep(time);
    }
    return reader_->GetOutput();
  }

  vtkPolyData* read(const std::string& name, const std::string& text)
  {
    reader_->AddFileName(fileOf(name, text).c_str());
    return read();
  }

  void expectError(const std::string& name, const std::string& text, const std::string& says)
  {
    EXPECT_EQ(read(name, text)->GetNumberOfPoints(), 0);
    EXPECT_EQ(errors_->count(), 1);
    EXPECT_NE(errors_->text().find(says), std::string::npos) << errors_->text();
    EXPECT_NE(errors_->text().find(name), std::string::npos) << errors_->text();
  }

  std::vector<double> times()
  {
    reader_->UpdateInformation();
    vtkInformation* info = reader_->GetOutputInformation(0);
    auto* const key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    return std::vector<double>(info->Get(key), info->Get(key) + info->Length(key));
  }

  vtkNew<vtkParticleTextReader> reader_;
  std::unique_ptr<ErrorCatcher> errors_;
  std::vector<std::string> files_;
};

std::vector<double> valuesOf(vtkPolyData* data, const char* name)
{
  std::vector<double> values;
  if (vtkDataArray* array = data->GetPointData()->GetArray(name))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      values.push_back(array->GetVariantValue(i).ToDouble());
    }
  }
  return values;
}

void expectPoint(vtkPolyData* data, vtkIdType i, double x, double y, double z)
{
  double p[3];
  data->GetPoint(i, p);
  EXPECT_NEAR(p[0], x, 1e-12);
  EXPECT_NEAR(p[1], y, 1e-12);
  EXPECT_NEAR(p[2], z, 1e-12);
}

std::string dump(int step, const std::string& columns, const std::string& rows, int count,
  const std::string& box = "ITEM: BOX BOUNDS pp pp pp\n0 10\n-20 20\n0 30\n")
{
  std::ostringstream text;
  text << "ITEM: TIMESTEP\n"
       << step << "\nITEM: NUMBER OF ATOMS\n"
       << count << '\n'
       << box << "ITEM: ATOMS " << columns << '\n'
       << rows;
  return text.str();
}

const std::string Columns = "id type x y z vx vy vz radius element";
const std::string Rows = "2 1 1.5 2 3e0 1 2 3 0.5 O\n1 2 -1 +0.25 7 4 5 6 1.5 Fe\n";

TEST_F(ParticleText, OfADumpComeInTheOrderOfIds)
{
  vtkPolyData* data = read("a.dump", dump(0, Columns, Rows, 2));
  ASSERT_EQ(data->GetNumberOfPoints(), 2);
  EXPECT_EQ(data->GetNumberOfVerts(), 2);
  expectPoint(data, 0, -1, 0.25, 7);
  expectPoint(data, 1, 1.5, 2, 3);
  EXPECT_EQ(valuesOf(data, "id"), (std::vector<double>{ 1, 2 }));
  EXPECT_EQ(valuesOf(data, "type"), (std::vector<double>{ 2, 1 }));
  EXPECT_EQ(valuesOf(data, "v"), (std::vector<double>{ 4, 5, 6, 1, 2, 3 }));
  EXPECT_EQ(valuesOf(data, "radius"), (std::vector<double>{ 1.5, 0.5 }));
  EXPECT_EQ(valuesOf(data, "atomic_number"), (std::vector<double>{ 26, 8 }));
  auto* symbols = vtkStringArray::SafeDownCast(data->GetPointData()->GetAbstractArray("element"));
  ASSERT_TRUE(symbols);
  EXPECT_EQ(symbols->GetValue(0), "Fe");
  EXPECT_EQ(errors_->count(), 0);
}

TEST_F(ParticleText, StepsAreATimeSeriesPlainAndPacked)
{
  const std::string series = "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n" + dump(100, Columns, Rows, 2) +
    dump(300, "id x y z", "1 7 8 9\n", 1) + dump(200, "id x y z", "", 0);
  for (const char* name : { "s.dump", "s.dump.gz" })
  {
    reader_->RemoveAllFileNames();
    reader_->AddFileName(fileOf(name, series).c_str());
    EXPECT_EQ(times(), (std::vector<double>{ 100, 200, 300 }));
    EXPECT_EQ(read(300)->GetNumberOfPoints(), 1);
    expectPoint(reader_->GetOutput(), 0, 7, 8, 9);
    EXPECT_EQ(read(100)->GetNumberOfPoints(), 2); // a step back
    EXPECT_EQ(read(250)->GetNumberOfPoints(), 0); // the one before
    EXPECT_EQ(errors_->count(), 0);
  }
  reader_->RemoveAllFileNames();
  reader_->AddFileName(fileOf("b.dump", dump(7, "id x y z", "1 7 8 9\n", 1)).c_str());
  reader_->AddFileName(fileOf("a.dump", dump(5, "id x y z", "1 1 1 1\n", 1)).c_str());
  EXPECT_EQ(times(), (std::vector<double>{ 5, 7 })); // of several files
  expectPoint(read(5), 0, 1, 1, 1);
}

TEST_F(ParticleText, ScaledCoordinatesAreMultipliedByTheBox)
{
  vtkPolyData* data = read("a.dump", dump(0, "id xs ys zs", "1 0.5 0.25 0.1\n", 1));
  expectPoint(data, 0, 5, -10, 3);
  // Edges a = (10 0 0), b = (2 20 0), c = (-3 4 30) from the corner (1 2 3): LAMMPS writes the
  // bounds of the whole parallelepiped.
  reader_->RemoveAllFileNames();
  data = read("t.dump",
    dump(0, "id xsu ysu zsu", "1 0.5 0.25 0.1\n", 1,
      "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-2 13 2\n2 26 -3\n3 33 4\n"));
  expectPoint(data, 0, 1 + 0.5 * 10 + 0.25 * 2 - 0.1 * 3, 2 + 0.25 * 20 + 0.1 * 4, 3 + 0.1 * 30);
}

TEST_F(ParticleText, BrokenDumpsSayWhatIsWrong)
{
  expectError(
    "c.dump", dump(0, "id type vx", "1 1 1\n", 1), "no coordinates among its columns id type vx");
  reader_->RemoveAllFileNames();
  expectError(
    "w.dump", dump(0, "id x y z", "1 1 1\n", 1), "3 values for particle 1 of a frame, not 4");
  reader_->RemoveAllFileNames();
  expectError("n.dump", dump(0, "id x y z", "1 1 1 1\n2 1 a 1\n", 2), "'a' for y of particle 2");
  reader_->RemoveAllFileNames();
  expectError("e.dump", dump(0, "id x y z", "1 1 1 1\n", 2), "ends after 1 of the 2 particles");
  reader_->RemoveAllFileNames();
  expectError("l.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\n", "no dump of atoms");
  reader_->RemoveAllFileNames();
  expectError("f.dump", "ITEM: TIMESTEP\nzero\n", "'zero' where the time step should be");
  reader_->RemoveAllFileNames();
  expectError("u.dump", "# a comment\n", "neither a LAMMPS text dump nor XYZ");
}

TEST_F(ParticleText, FramesBeforeABreakAreRead)
{
  const std::string text =
    dump(1, "id x y z", "1 1 1 1\n", 1) + dump(2, "id x y z", "1 1 1 1\n", 2);
  WarningCatcher warnings(reader_);
  EXPECT_EQ(read("a.dump", text)->GetNumberOfPoints(), 1);
  EXPECT_EQ(times(), std::vector<double>{ 1 });
  EXPECT_NE(warnings.text().find("ends after 1 of the 2 particles"), std::string::npos);
  EXPECT_EQ(errors_->count(), 0);
}

TEST_F(ParticleText, APackedFileThatBreaksOffSaysSo)
{
  std::string rows;
  for (int i = 1; i <= 20000; ++i)
  {
    rows +=
      std::to_string(i) + " " + std::to_string(i * 0.37) + " " + std::to_string(i % 17) + " 3\n";
  }
  const std::string whole = fileOf("w.dump.gz", dump(0, "id x y z", rows, 20000));
  std::ostringstream bytes;
  bytes << std::ifstream(whole, std::ios::binary).rdbuf();
  const std::string half = testing::TempDir() + "particle-text-half.dump.gz";
  files_.push_back(half);
  std::ofstream(half, std::ios::binary) << bytes.str().substr(0, bytes.str().size() / 2);
  reader_->AddFileName(half.c_str());
  EXPECT_EQ(read()->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors_->count(), 1);
  EXPECT_NE(errors_->text().find("half.dump.gz"), std::string::npos) << errors_->text();
  reader_->RemoveAllFileNames();
  reader_->AddFileName(whole.c_str());
  EXPECT_EQ(read()->GetNumberOfPoints(), 20000);
}

TEST_F(ParticleText, OfXyzWithFramesAndFurtherColumns)
{
  const std::string text = "2\nwater\nO 0 0 0 -0.8\nH 1 0 0 0.4\n\n1\r\n\r\nFe 1 2 3 0\r\n";
  for (const char* name : { "a.xyz", "a.xyz.gz" })
  {
    reader_->RemoveAllFileNames();
    reader_->AddFileName(fileOf(name, text).c_str());
    EXPECT_EQ(times(), (std::vector<double>{ 0, 1 }));
    vtkPolyData* data = read(0);
    ASSERT_EQ(data->GetNumberOfPoints(), 2) << errors_->text();
    EXPECT_EQ(valuesOf(data, "column5"), (std::vector<double>{ -0.8, 0.4 }));
    EXPECT_EQ(valuesOf(data, "atomic_number"), (std::vector<double>{ 8, 1 }));
    data = read(1);
    ASSERT_EQ(data->GetNumberOfPoints(), 1);
    expectPoint(data, 0, 1, 2, 3);
  }
}

TEST_F(ParticleText, OfExtendedXyz)
{
  vtkPolyData* data = read("e.extxyz",
    "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=id:I:1:species:S:1:pos:R:3:forces:R:3:radius:R:1 "
    "Time=3\n"
    "7 Si 1 2 3 4 5 6 0.5\n");
  ASSERT_EQ(data->GetNumberOfPoints(), 1) << errors_->text();
  expectPoint(data, 0, 1, 2, 3);
  EXPECT_EQ(valuesOf(data, "forces"), (std::vector<double>{ 4, 5, 6 }));
  EXPECT_EQ(valuesOf(data, "radius"), std::vector<double>{ 0.5 });
  EXPECT_EQ(valuesOf(data, "atomic_number"), std::vector<double>{ 14 });
}

TEST_F(ParticleText, BrokenXyzSaysWhatIsWrong)
{
  expectError("s.xyz", "2\n\nO 0 0 0\n", "ends after 1 of the 2 particles");
  reader_->RemoveAllFileNames();
  expectError("t.xyz", "1\n\n0 0 0\n", "an element and three coordinates are needed");
  reader_->RemoveAllFileNames();
  expectError("p.xyz", "1\nProperties=species:S:1\nO\n", "no pos:R:3");
  reader_->RemoveAllFileNames();
  expectError("x.xyz", "1\n\nO a 0 0\n", "words in the column x");
  reader_->RemoveAllFileNames();
  expectError("m.xyz", "", "neither a LAMMPS text dump nor XYZ");
}

TEST_F(ParticleText, AreRecognisedByTheirFirstLine)
{
  EXPECT_EQ(
    vtkParticleTextReader::CanReadFile(fileOf("r.dump", dump(0, "id x y z", "", 0)).c_str()), 1);
  EXPECT_EQ(vtkParticleTextReader::CanReadFile(fileOf("r.xyz.gz", "12\n\n").c_str()), 1);
  EXPECT_EQ(vtkParticleTextReader::CanReadFile(fileOf("plot.xyz", "2 3 4\n").c_str()), 0);
  EXPECT_EQ(vtkParticleTextReader::CanReadFile("no-such-file.dump"), 0);
  EXPECT_EQ(vtkParticleTextReader::CanReadFile(nullptr), 0);
}

TEST_F(ParticleText, MissingFilesAreNamed)
{
  reader_->AddFileName("no-such-file.dump");
  EXPECT_EQ(read()->GetNumberOfPoints(), 0);
  EXPECT_NE(errors_->text().find("'no-such-file.dump' cannot be opened"), std::string::npos);
  reader_->RemoveAllFileNames();
  EXPECT_EQ(read()->GetNumberOfPoints(), 0);
  EXPECT_NE(errors_->text().find("set FileNames"), std::string::npos);
}
}
