// SPDX-License-Identifier: BSD-3-Clause
// Textures of a file that the mapper loads while they are seen. Real windows: these tests need a
// display with OpenGL, Xvfb for instance.
#include "RayTracedSphereTestScene.h"
#include "TemporaryFolder.h"
#include "VTKErrors.h"

#include "OcclusionParameters.h"
#include "OcclusionTextureFile.h"
#include "vtkOcclusionTextureWriter.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <thread>

namespace
{
namespace fs = std::filesystem;

constexpr int Side = 12, Resolution = 8, TextureBytes = Resolution * Resolution;
constexpr int Textures = Side * Side * Side;
constexpr double BytesPerMiB = 1024 * 1024;

/// A budget for so many textures, in MiB.
double budgetFor(int textures)
{
  return textures * (TextureBytes + 16) / BytesPerMiB;
}

/// Random textures, one a point.
void bakeRandom(vtkPolyData* data, unsigned seed = 1)
{
  std::mt19937 random(seed);
  const vtkIdType count = data->GetNumberOfPoints();
  vtkNew<vtkFloatArray> means;
  means->SetName(po::OcclusionArray);
  vtkNew<vtkIntArray> rows;
  rows->SetName(po::TextureIndexArray);
  vtkNew<vtkUnsignedCharArray> table;
  table->SetName(po::TextureTableArray);
  table->SetNumberOfComponents(TextureBytes);
  table->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < table->GetNumberOfValues(); ++i)
  {
    table->SetValue(i, static_cast<unsigned char>(random() % 256));
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    means->InsertNextValue(0.2f);
    rows->InsertNextValue(static_cast<int>(count - 1 - i));
  }
  po::OcclusionParameters parameters;
  parameters.set("resolution", Resolution);
  parameters.set("encoding", po::UInt8Gamma2);
  parameters.set("maximum", 1.0);
  parameters.toFieldData(data->GetFieldData());
  data->GetFieldData()->AddArray(table);
  data->GetPointData()->AddArray(means);
  data->GetPointData()->AddArray(rows);
}

void writeTextures(vtkPolyData* data, const std::string& name)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(name.c_str());
  ASSERT_EQ(writer->Write(), 1);
}

/// The same particles twice: with textures in memory, and with those of a file.
class TextureFilePaging : public testing::Test
{
protected:
  void SetUp() override
  {
    bakeRandom(memory.mapper->GetInput());
    writeTextures(memory.mapper->GetInput(), file);
    for (Scene* scene : { &memory, &paged })
    {
      scene->mapper->SetShadingMode(vtkRayTracedSphereMapper::AMBIENT_OCCLUSION);
    }
    paged.mapper->SetTextureFile(file.c_str());
  }

  /// Both scenes from the same place.
  void look(double azimuth, double dolly)
  {
    for (Scene* scene : { &memory, &paged })
    {
      vtkCamera* camera = scene->renderer->GetActiveCamera();
      camera->SetPosition(0, 0, 1);
      camera->SetFocalPoint(0, 0, 0);
      camera->SetViewUp(0, 1, 0);
      scene->renderer->ResetCamera();
      camera->Azimuth(azimuth);
      camera->Dolly(dolly);
      scene->renderer->ResetCameraClippingRange();
    }
  }

  void expectSamePicture()
  {
    EXPECT_EQ(differingShare(grab(paged.window), grab(memory.window), 0), 0);
    EXPECT_EQ(paged.mapper->GetNumberOfMissingTextures(), 0);
  }

  /// Without textures, and with one error that says what is in the text.
  void expectError(const std::string& text)
  {
    look(0, 1);
    ErrorCatcher errors(paged.mapper);
    const Picture picture = grab(paged.window);
    (void)grab(paged.window);
    EXPECT_EQ(errors.count(), 1);
    EXPECT_NE(errors.text().find("TextureFile"), std::string::npos) << errors.text();
    EXPECT_NE(errors.text().find(text), std::string::npos) << errors.text();
    Scene bare(lattice(Side));
    bare.mapper->SetShadingMode(vtkRayTracedSphereMapper::AMBIENT_OCCLUSION);
    EXPECT_EQ(differingShare(picture, grab(bare.window), 0), 0) << "the spheres are drawn";
  }

  TemporaryFolder folder;
  std::string file = folder.file("textures.exr");
  Scene memory{ lattice(Side) };
  Scene paged{ lattice(Side) };
};

TEST_F(TextureFilePaging, ShowsWhatATableInMemoryShowsAndReadsOnlyWhatIsSeen)
{
  expectSamePicture();
  EXPECT_GT(paged.mapper->GetNumberOfResidentTextures(), 100);
  EXPECT_LT(paged.mapper->GetNumberOfResidentTextures(), Textures - 100);
  EXPECT_EQ(paged.mapper->GetResidentTextureBytes(),
    paged.mapper->GetNumberOfResidentTextures() * (TextureBytes + 16));
  paged.mapper->SetTextureFile(nullptr);
  EXPECT_GT(differingShare(grab(paged.window), grab(memory.window)), 0.2);
  EXPECT_EQ(paged.mapper->GetNumberOfResidentTextures(), 0);
}

/// Some of the points, the last one first, with their textures.
vtkSmartPointer<vtkPolyData> reversedPart(
  vtkPolyData* whole, const std::function<bool(vtkIdType)>& keep)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(whole->GetPoints()->GetDataType());
  result->GetPointData()->CopyAllocate(whole->GetPointData());
  for (vtkIdType i = whole->GetNumberOfPoints() - 1; i >= 0; --i)
  {
    if (keep(i))
    {
      const vtkIdType place = points->InsertNextPoint(whole->GetPoint(i));
      result->GetPointData()->CopyData(whole->GetPointData(), i, place);
    }
  }
  result->SetPoints(points);
  result->GetFieldData()->ShallowCopy(whole->GetFieldData());
  return result;
}

TEST_F(TextureFilePaging, AnOtherOrderAndAPartFindTheirTexturesByPlace)
{
  const vtkSmartPointer<vtkPolyData> whole = memory.mapper->GetInput();
  for (const bool all : { true, false })
  {
    SCOPED_TRACE(all ? "another order" : "a part");
    const auto keep = [&](vtkIdType i) { return all || i % 3 == 1; };
    const auto part = reversedPart(whole, keep);
    memory.mapper->SetInputData(part);
    vtkNew<vtkPolyData> bare;
    bare->DeepCopy(part);
    bare->GetPointData()->RemoveArray(po::OcclusionArray);
    bare->GetPointData()->RemoveArray(po::TextureIndexArray);
    bare->GetFieldData()->Initialize();
    paged.mapper->SetInputData(bare);
    look(30, 1);
    ErrorCatcher errors(paged.mapper);
    expectSamePicture();
    EXPECT_EQ(errors.count(), 0) << errors.text();
    EXPECT_GT(paged.mapper->GetNumberOfResidentTextures(), 50);
  }
}

TEST_F(TextureFilePaging, APartWithAParticleThatTheFileLacksIsAnError)
{
  const auto part = reversedPart(paged.mapper->GetInput(), [](vtkIdType i) { return i % 2 == 0; });
  part->GetPoints()->SetPoint(7, 0.25, 0.25, 0.25);
  paged.mapper->SetInputData(part);
  ErrorCatcher errors(paged.mapper);
  (void)grab(paged.window);
  EXPECT_EQ(errors.count(), 1);
  EXPECT_NE(errors.text().find("particles, but the input has"), std::string::npos) << errors.text();
}

TEST_F(TextureFilePaging, FileTakesThePlaceOfTexturesOfThePoints)
{
  bakeRandom(paged.mapper->GetInput(), 2);
  expectSamePicture();
}

TEST_F(TextureFilePaging, AFlightThroughTenTimesTheBudget)
{
  constexpr int held = Textures / 10;
  paged.mapper->SetTextureBudget(budgetFor(held));
  for (int step = 0; step < 12; ++step)
  {
    paged.window->SetDesiredUpdateRate(15); // dragging
    look(7 * step, 1 + step);
    paged.window->Render();
    EXPECT_LE(paged.mapper->GetResidentTextureBytes(), held * (TextureBytes + 16));
  }
  paged.window->SetDesiredUpdateRate(0.0001);
  expectSamePicture();
  EXPECT_LE(paged.mapper->GetResidentTextureBytes(), held * (TextureBytes + 16));
  look(0, 1);
  paged.window->Render();
  EXPECT_GT(paged.mapper->GetNumberOfMissingTextures(), 50) << "more than the budget holds";
  EXPECT_EQ(paged.mapper->GetNumberOfResidentTextures(), held);
  paged.mapper->SetTextureBudget(256);
  expectSamePicture();
}

TEST_F(TextureFilePaging, ProgressivePicturesAskForMoreUntilAllIsThere)
{
  int updates = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&updates);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  paged.mapper->AddObserver(vtkCommand::UpdateEvent, counter);
  paged.mapper->ProgressiveOn();
  for (Scene* scene : { &memory, &paged })
  {
    scene->mapper->SetSamplesPerPixel(4);
  }
  paged.window->Render();
  EXPECT_GT(paged.mapper->GetNumberOfMissingTextures(), 0) << "the first picture waits for nothing";
  EXPECT_EQ(updates, 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  for (int before = 0; updates > before && std::chrono::steady_clock::now() < end;)
  {
    if (paged.mapper->HasMoreToShow())
    {
      before = updates;
      paged.window->Render();
    }
    std::this_thread::yield();
  }
  EXPECT_EQ(paged.mapper->GetNumberOfSamples(), 4);
  expectSamePicture();
}

TEST_F(TextureFilePaging, LayersWaitForTheirTextures)
{
  paged.mapper->ProgressiveOn();
  const auto layersOf = [](Scene& scene)
  { return scene.mapper->RenderLayers(scene.renderer, scene.actor, 300, 200); };
  paged.window->Render();
  const auto expected = layersOf(memory), found = layersOf(paged);
  for (const char* name : { "RGBA", "AO" })
  {
    vtkDataArray* a = expected->GetPointData()->GetArray(name);
    vtkDataArray* b = found->GetPointData()->GetArray(name);
    ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
    bool same = true;
    for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
    {
      same = same && a->GetVariantValue(i) == b->GetVariantValue(i);
    }
    EXPECT_TRUE(same) << name;
  }
}

TEST_F(TextureFilePaging, AFileThatIsRemovedWhileItIsShownGoesOn)
{
  look(0, 3);
  paged.window->Render();
  fs::remove(file);
  look(180, 3);
  ErrorCatcher errors(paged.mapper);
  expectSamePicture();
  EXPECT_EQ(errors.count(), 0) << "it stays open";
  paged.mapper->ReleaseSpheres();
  expectError("there is no such file");
}

TEST_F(TextureFilePaging, AFileThatIsTruncatedWhileItIsShownGivesOneErrorAndMeans)
{
  look(0, 3);
  paged.window->Render();
  const vtkIdType before = paged.mapper->GetNumberOfResidentTextures();
  EXPECT_GT(before, 0);
  fs::resize_file(file, 1000);
  look(180, 3);
  ErrorCatcher errors(paged.mapper);
  const Picture picture = grab(paged.window);
  (void)grab(paged.window);
  EXPECT_EQ(errors.count(), 1);
  EXPECT_NE(errors.text().find(file), std::string::npos) << errors.text();
  EXPECT_NE(errors.text().find("mean"), std::string::npos) << errors.text();
  EXPECT_GT(paged.mapper->GetNumberOfMissingTextures(), 0);
  EXPECT_GT(layer(paged, "id")->GetRange()[1], 0) << "the spheres are drawn";
  look(0, 3);
  expectSamePicture(); // what is in memory stays
  EXPECT_EQ(errors.count(), 1);

  writeTextures(memory.mapper->GetInput(), file);
  paged.mapper->ReleaseSpheres(); // as when they are hidden and shown
  look(180, 3);
  expectSamePicture();
}

TEST_F(TextureFilePaging, ABudgetOfZeroGivesOneWarningAndMeans)
{
  paged.mapper->SetTextureBudget(0);
  WarningCatcher warnings(paged.mapper);
  grab(paged.window);
  grab(paged.window);
  EXPECT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("TextureBudget: 0 MiB"), std::string::npos) << warnings.text();
  vtkDataArray* occlusion = layer(paged, "AO");
  EXPECT_FLOAT_EQ(static_cast<float>(occlusion->GetRange()[1]), 0.2f);
  paged.mapper->SetTextureBudget(1);
  expectSamePicture();
  EXPECT_EQ(warnings.count(), 1);
}

TEST_F(TextureFilePaging, AFileOfOtherPositionsGivesOneWarning)
{
  paged.mapper->GetInput()->GetPoints()->SetPoint(5, 5, 0.1, 0);
  paged.mapper->GetInput()->GetPoints()->Modified();
  WarningCatcher warnings(paged.mapper);
  grab(paged.window);
  grab(paged.window);
  EXPECT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("other positions"), std::string::npos) << warnings.text();
  EXPECT_GT(paged.mapper->GetNumberOfResidentTextures(), 0);
}

TEST_F(TextureFilePaging, AFileForAnotherNumberOfParticlesIsAnError)
{
  Scene other(lattice(3));
  bakeRandom(other.mapper->GetInput());
  writeTextures(other.mapper->GetInput(), file);
  expectError("27 particles");
}

TEST_F(TextureFilePaging, AFileWhoseResolutionIsNotThatOfItsParametersIsAnError)
{
  po::OcclusionTextureSource source;
  source.resolution = 4;
  source.textureCount = source.particleCount = Textures;
  source.parameters =
    po::OcclusionParameters::fromFieldData(memory.mapper->GetInput()->GetFieldData());
  source.texture = [](std::int64_t, float* texels) { std::fill_n(texels, 16, 0.5f); };
  const std::vector<std::int32_t> rows(Textures, 0);
  const std::vector<float> means(Textures, 0.5f);
  source.rows = rows.data();
  source.means = means.data();
  po::writeOcclusionTextures(file, source);
  expectError("4 texels a side, but its parameters say resolution=8");
}

TEST_F(TextureFilePaging, AFileThatIsNoTextureFileIsAnError)
{
  paged.mapper->SetTextureFile(fs::path(file).parent_path().c_str());
  expectError("it is not a file");
}
}
