// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureTestData.h"

#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

TEST(OcclusionParameters, SurviveVtpFiles)
{
  TemporaryFolder folder;
  PolyData baked = bakedBytes(20, 4, 8, 1.0 / 3.0);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(baked);
  writer->SetDataModeToBinary();
  writer->SetFileName(folder.file("a.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("a.vtp").c_str());
  reader->Update();
  expectSameStrings(baked->GetFieldData(), reader->GetOutput()->GetFieldData());
  const auto parameters =
    po::OcclusionParameters::fromFieldData(reader->GetOutput()->GetFieldData());
  EXPECT_EQ(parameters.getDouble("maximum"), 1.0 / 3.0);
  EXPECT_EQ(parameters.get("background"), "gradient, up = (0, 0, 1)");
}

TEST(OcclusionParameters, KeepOrderAndReplace)
{
  po::OcclusionParameters parameters;
  parameters.set("b", 1);
  parameters.set("a", "x=y");
  parameters.set("b", 0.1);
  parameters.set("c", true);
  const std::vector<std::string> strings = { "b=0.10000000000000001", "a=x=y", "c=1" };
  EXPECT_EQ(parameters.toStrings(), strings);
  EXPECT_EQ(po::OcclusionParameters::fromStrings(strings).entries(), parameters.entries());
  EXPECT_TRUE(parameters.has("a"));
  EXPECT_FALSE(parameters.has("d"));
}

TEST(OcclusionParameters, ErrorsNameTheKey)
{
  po::OcclusionParameters parameters;
  parameters.set("text", "12 apples");
  EXPECT_HAS(whatIsThrown([&]() { (void)parameters.get("seed"); }), "\"seed\"");
  EXPECT_HAS(whatIsThrown([&]() { (void)parameters.getInteger("text"); }), "\"12 apples\"");
  EXPECT_HAS(whatIsThrown([&]() { (void)parameters.getDouble("text"); }), "\"text\"");
  EXPECT_HAS(
    whatIsThrown([]() { (void)po::OcclusionParameters::fromStrings({ "oops" }); }), "oops");
  EXPECT_HAS(whatIsThrown([]() { (void)po::OcclusionParameters::fromStrings({ "=1" }); }), "=1");
  EXPECT_HAS(whatIsThrown([&]() { parameters.set("a=b", 1); }), "a=b");
}
