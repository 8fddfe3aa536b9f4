// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureTestData.h"

#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

TEST(OcclusionParameters, SurviveVtpFiles)
{
  TemporaryFolder folder;
  PolyData baked = BakedBytes(20, 4, 8, 1.0 / 3.0);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(baked);
  writer->SetDataModeToBinary();
  writer->SetFileName(folder.File("a.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.File("a.vtp").c_str());
  reader->Update();
  ExpectSameStrings(baked->GetFieldData(), reader->GetOutput()->GetFieldData());
  const auto parameters =
    po::OcclusionParameters::FromFieldData(reader->GetOutput()->GetFieldData());
  EXPECT_EQ(parameters.GetDouble("maximum"), 1.0 / 3.0);
  EXPECT_EQ(parameters.Get("background"), "gradient, up = (0, 0, 1)");
}

TEST(OcclusionParameters, KeepOrderAndReplace)
{
  po::OcclusionParameters parameters;
  parameters.Set("b", 1);
  parameters.Set("a", "x=y");
  parameters.Set("b", 0.1);
  parameters.Set("c", true);
  const std::vector<std::string> strings = { "b=0.10000000000000001", "a=x=y", "c=1" };
  EXPECT_EQ(parameters.ToStrings(), strings);
  EXPECT_EQ(po::OcclusionParameters::FromStrings(strings).Entries(), parameters.Entries());
  EXPECT_TRUE(parameters.Has("a"));
  EXPECT_FALSE(parameters.Has("d"));
}

TEST(OcclusionParameters, ErrorsNameTheKey)
{
  po::OcclusionParameters parameters;
  parameters.Set("text", "12 apples");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.Get("seed"); }), "\"seed\"");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.GetInteger("text"); }), "\"12 apples\"");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.GetDouble("text"); }), "\"text\"");
  EXPECT_HAS(
    WhatIsThrown([]() { (void)po::OcclusionParameters::FromStrings({ "oops" }); }), "oops");
  EXPECT_HAS(WhatIsThrown([]() { (void)po::OcclusionParameters::FromStrings({ "=1" }); }), "=1");
  EXPECT_HAS(WhatIsThrown([&]() { parameters.Set("a=b", 1); }), "a=b");
}
