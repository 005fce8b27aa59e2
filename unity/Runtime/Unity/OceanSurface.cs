using System;
using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Pelagic.Unity
{
    /// <summary>
    /// Draws the sea of an OceanBehaviour with four cascades for one camera: patches of a quadtree, with the shader
    /// Pelagic/Ocean.
    /// </summary>
    public sealed class OceanSurface : MonoBehaviour
    {
        private const int Cascades = 4, FoamCascades = 3, PatchesOfDraw = 511;
        private const float WaterIndex = 1.333f;
        private const double LaceM = 17, Gravity = 9.80665;

        private static readonly int placeId = Shader.PropertyToID("_PelagicCascadePlace"), scaleId = Shader.PropertyToID("_PelagicCascadeScale"),
                                    slopeId = Shader.PropertyToID("_PelagicCascadeSlope"), foamCascadeId = Shader.PropertyToID("_PelagicFoamCascade"),
                                    foamAgeId = Shader.PropertyToID("_PelagicFoamAge"), foamKindId = Shader.PropertyToID("_PelagicFoamKind"),
                                    foamFrontId = Shader.PropertyToID("_PelagicFoamFront"),
                                    viewerId = Shader.PropertyToID("_PelagicViewer"), gridId = Shader.PropertyToID("_PelagicGrid"),
                                    fadeId = Shader.PropertyToID("_PelagicFade"), meshId = Shader.PropertyToID("_PelagicMesh"),
                                    sunId = Shader.PropertyToID("_PelagicSun"), sunIrradianceId = Shader.PropertyToID("_PelagicSunIrradiance"),
                                    skyIrradianceId = Shader.PropertyToID("_PelagicSkyIrradiance"), absorptionId = Shader.PropertyToID("_PelagicAbsorption"),
                                    backscatteringId = Shader.PropertyToID("_PelagicBackscattering"), crestRayId = Shader.PropertyToID("_PelagicCrestRay"),
                                    crestSunId = Shader.PropertyToID("_PelagicCrestSun"), crestSkyId = Shader.PropertyToID("_PelagicCrestSky"),
                                    wavesId = Shader.PropertyToID("_PelagicWaves"), rippleTurnId = Shader.PropertyToID("_PelagicRippleTurn"),
                                    detailPlaceId = Shader.PropertyToID("_PelagicDetailPlace"), ripplesId = Shader.PropertyToID("_PelagicRipples"),
                                    laceId = Shader.PropertyToID("_PelagicLace"), patchesId = Shader.PropertyToID("_PelagicPatches");

        public OceanBehaviour Source;
        [Tooltip("The camera that sees the sea, and that defines the level of detail.")]
        public Camera Camera;
        [Tooltip("A directional light.")]
        public Light Sun;
        [Tooltip("A material with the shader Pelagic/Ocean. Its properties are overwritten in each frame.")]
        public Material Material;
        [Range(256, 8192), Tooltip("Side of the square of sea around the camera, in metres.")]
        public float SizeM = 2048;
        [Range(2, 128), Tooltip("Steps along a patch, an even number.")]
        public int PatchVertices = 32;
        [Range(0.75f, 8), Tooltip("A patch splits nearer than this times its side.")]
        public float LodScale = 2;
        [Tooltip("Absorption of red, green and blue light, 1/m. By default that of Jerlov's type II.")]
        public Vector3 AbsorptionPerM = new Vector3(0.2652f, 0.07426f, 0.05485f);
        [Tooltip("Backscattering of red, green and blue light, 1/m. By default that of Jerlov's type II.")]
        public Vector3 BackscatteringPerM = new Vector3(0.002456f, 0.002862f, 0.003947f);

        // Equal in all scenes, and slow to compute.
        private static byte[][] rippleLevels, laceLevels;

        private readonly Vector4[] place = new Vector4[Cascades], scale = new Vector4[Cascades], slope = new Vector4[Cascades],
                                   foamCascade = new Vector4[FoamCascades], foamAge = new Vector4[2], patches = new Vector4[2 * PatchesOfDraw];
        private readonly UnityEngine.Plane[] planes = new UnityEngine.Plane[6];
        private readonly double[] planesOfSea = new double[24];
        private readonly Vector3[] up = { new Vector3(0, 1, 0) };
        private readonly Color[] ambient = new Color[1];
        // One for each draw, because a draw reads its properties later.
        private readonly List<MaterialPropertyBlock> properties = new List<MaterialPropertyBlock>();
        private (float SizeM, int PatchVertices, float LodScale) built;
        private string problem;
        private Mesh mesh;
        private Texture2D ripples, lace;

        /// <summary>The patches of the last LateUpdate(); null before.</summary>
        public Quadtree Quadtree { get; private set; }

        /// <summary>One line about why nothing is drawn, or null.</summary>
        public string Problem => problem;

        private void OnValidate()
        {
            PatchVertices = Math.Max(2, PatchVertices & ~1);
        }

        private void OnEnable()
        {
            rippleLevels = rippleLevels ?? DetailTextures.Ripples();
            laceLevels = laceLevels ?? DetailTextures.Lace();
            ripples = TextureOf(rippleLevels);
            lace = TextureOf(laceLevels);
        }

        // After the Update() of the source, which completes the frame.
        private void LateUpdate()
        {
            Problems.Report(ref problem, FirstProblem(), this);
            if (problem != null || !Source.HasFrame) return;
            Build();
            var frame = Source.Frame;
            var viewer = Camera.transform.position;
            var water = frame.Water;
            SetWaves(frame, viewer.x + frame.OriginXM - water.CurrentXMps * frame.TimeS, frame.OriginZM - viewer.z - water.CurrentZMps * frame.TimeS);
            SetLight();
            Material.SetVector(viewerId, Vector(viewer.x, viewer.y, viewer.z, water.SeaLevelM));
            Material.SetTexture(ripplesId, ripples);
            Material.SetTexture(laceId, lace);
            Select(frame, viewer);
            Draw(frame, viewer);
        }

        private void OnDisable()
        {
            if (mesh != null) Destroy(mesh);
            mesh = null;
            Quadtree = null;
            built = default;
            Destroy(ripples);
            Destroy(lace);
        }

        private string FirstProblem()
        {
            if (Source == null) return "Source is none, expected an OceanBehaviour";
            if (Camera == null) return "Camera is none, expected the camera that sees the sea";
            if (Sun == null) return "Sun is none, expected a directional light";
            if (Material == null) return "Material is none, expected one with the shader Pelagic/Ocean";
            if (Source.HasFrame && Source.Frame.CascadeCount != Cascades) return $"the sea of '{Source.name}' has {Source.Frame.CascadeCount} cascades, expected {Cascades}";
            if (!(SizeM >= 256 && SizeM <= 8192)) return $"SizeM is {SizeM}, expected a value in [256, 8192]";
            if (PatchVertices < 2 || PatchVertices > 128 || PatchVertices % 2 != 0) return $"PatchVertices is {PatchVertices}, expected an even number in [2, 128]";
            if (!(LodScale >= 0.75f && LodScale <= 8)) return $"LodScale is {LodScale}, expected a value in [0.75, 8]";
            return null;
        }

        /// <summary>Makes patches of the sizes that the fields have.</summary>
        private void Build()
        {
            if (built.SizeM == SizeM && built.PatchVertices == PatchVertices && built.LodScale == LodScale) return;
            if (mesh != null) Destroy(mesh);
            Quadtree = new Quadtree(SizeM, PatchVertices, LodScale);
            mesh = PatchMesh(PatchVertices);
            built = (SizeM, PatchVertices, LodScale);
        }

        /// <summary>Sets what depends on the frame and on the viewer's x and z in the sea.</summary>
        private void SetWaves(in Frame frame, double x, double z)
        {
            var sea = Source.Sea;
            double longestWaveM = frame.Cascade(0).SideM, texelM = 0;
            for (var i = 0; i < Cascades; ++i)
            {
                var cascade = frame.Cascade(i);
                double side = cascade.SideM, half = 0.5 / cascade.Resolution;
                texelM = side / cascade.Resolution;
                // Few analytic waves are also in finer cascades.
                if (i > 0 && sea.Waves == WavesKind.Analytic) longestWaveM = Math.Max(longestWaveM, side / 8);
                place[i] = Vector(Fraction((cascade.Cosine * x + cascade.Sine * z) / side + half), Fraction((cascade.Cosine * z - cascade.Sine * x) / side + half),
                                  cascade.Cosine / side, cascade.Sine / side);
                scale[i] = Vector(1 / texelM, Math.Log(longestWaveM / texelM, 2), side, 0);
                // The last level has averaged away all waves: green and blue are their variance.
                var last = Source.Moments.GetPixelData<uint>(cascade.Levels - 1, i)[0];
                slope[i] = Vector(cascade.SlopeRange, cascade.VarianceRange, ((last >> 8 & 255) + (last >> 16 & 255)) / 255.0 * cascade.VarianceRange, 0);
                if (i < FoamCascades)
                    foamCascade[i] = Vector(cascade.DriftColumns / cascade.Resolution, cascade.DriftRows / cascade.Resolution, cascade.CompressionScale,
                                            cascade.SnapshotsRgba8(0).IsEmpty ? 0 : 1);
                longestWaveM = 3 * texelM;
            }
            for (var i = 0; i < foamAge.Length; ++i)
                foamAge[i] = new Vector4(frame.FoamAge(4 * i), frame.FoamAge(4 * i + 1), frame.FoamAge(4 * i + 2), frame.FoamAge(4 * i + 3));
            Material.SetVectorArray(placeId, place);
            Material.SetVectorArray(scaleId, scale);
            Material.SetVectorArray(slopeId, slope);
            Material.SetVectorArray(foamCascadeId, foamCascade);
            Material.SetVectorArray(foamAgeId, foamAge);
            Material.SetVector(foamKindId, new Vector4(frame.FoamLevel, 0, 0, 0));
            Material.SetVector(foamFrontId, new Vector4(frame.Cascade(0).CompressionFrontX, frame.Cascade(0).CompressionFrontZ, 0, 0));
            Material.SetVector(wavesId, Vector(Math.Max(0.05, frame.WaveHeightM), frame.Roughness, 0, 0));

            // Ripples run downwind at the speed of deep-water waves of a tenth of their period, and repeat in a loop.
            double loop = Fraction(frame.TimeS / sea.LoopPeriodS), rippleM = Math.Max(6 * texelM, DetailTextures.RipplesM), angle = sea.WindDirectionRad + 0.21;
            double cosine = Math.Cos(angle), sine = Math.Sin(angle), speed = Math.Sqrt(Gravity * rippleM / 10 / (2 * Math.PI));
            var moved = Math.Round(speed * sea.LoopPeriodS / rippleM) * loop;
            Material.SetVector(rippleTurnId, Vector(cosine / rippleM, sine / rippleM, cosine, sine));
            Material.SetVector(detailPlaceId, Vector(Fraction((cosine * x + sine * z) / rippleM - moved), Fraction((cosine * z - sine * x) / rippleM),
                                                     LacePlace(x, frame.FoamDriftXMps, loop), LacePlace(z, frame.FoamDriftZMps, loop)));
            Material.SetVector(backscatteringId, WithW(BackscatteringPerM, 0.75f * frame.Roughness * frame.Roughness));
            Material.SetVector(absorptionId, WithW(AbsorptionPerM, 0));
        }

        /// <summary>Coordinate of the viewer in the lace, which drifts with the foam.</summary>
        private double LacePlace(double at, double driftMps, double loop)
        {
            return Fraction(at / LaceM - Math.Round(driftMps * Source.Sea.LoopPeriodS / LaceM) * loop);
        }

        /// <summary>
        /// Sets the light. In URP a light of intensity 1 gives a white matt surface that faces it a radiance of 1, so
        /// its irradiance is pi; so does the ambient probe.
        /// </summary>
        private void SetLight()
        {
            var towards = Sun.transform.forward;
            var sun = new Vector3(-towards.x, -towards.y, towards.z);
            var colour = Sun.color.linear;
            var power = (float)Math.PI * Sun.intensity;
            var sunIrradiance = new Vector3(colour.r * power, colour.g * power, colour.b * power);
            RenderSettings.ambientProbe.Evaluate(up, ambient);
            var skyIrradiance = new Vector3(ambient[0].r * (float)Math.PI, ambient[0].g * (float)Math.PI, ambient[0].b * (float)Math.PI);
            Material.SetVector(sunId, WithW(sun, 0));
            Material.SetVector(sunIrradianceId, WithW(sunIrradiance, 0));
            Material.SetVector(skyIrradianceId, WithW(skyIrradiance, 0));

            // Light through crests: place_crest_light() of gl/water/scene_block.cpp.
            var across = (float)Math.Max(Math.Sqrt(sun.x * sun.x + sun.z * sun.z), 1e-6);
            var length = (float)Math.Sqrt(0.25 * 0.25 + 1);
            var back = new Vector3(0.25f * sun.x / across / length, 1 / length, 0.25f * sun.z / across / length);
            var incident = back.x * sun.x + back.y * sun.y + back.z * sun.z;
            var inner = (float)Math.Sqrt(1 - (1 - incident * incident) / (WaterIndex * WaterIndex));
            var along = incident / WaterIndex - inner;
            var ray = new Vector3(along * back.x - sun.x / WaterIndex, along * back.y - sun.y / WaterIndex, along * back.z - sun.z / WaterIndex);
            var cosine = Math.Max(incident, 0.01f);
            float s = (cosine - WaterIndex * inner) / (cosine + WaterIndex * inner), p = (WaterIndex * cosine - inner) / (WaterIndex * cosine + inner);
            var entering = (1 - 0.5f * (s * s + p * p)) * cosine / inner / (WaterIndex * WaterIndex);
            Material.SetVector(crestRayId, WithW(ray, 1.75f / ray.y));
            Material.SetVector(crestSunId, new Vector4(sunIrradiance.x * entering, sunIrradiance.y * entering, sunIrradiance.z * entering, 0));
            Material.SetVector(crestSkyId, new Vector4(skyIrradiance.x * 0.056f, skyIrradiance.y * 0.056f, skyIrradiance.z * 0.056f, 0));
        }

        private void Select(in Frame frame, Vector3 viewer)
        {
            // The quadtree's heights begin at still water.
            var level = frame.Water.SeaLevelM;
            GeometryUtility.CalculateFrustumPlanes(Camera.cullingMatrix, planes);
            for (var i = 0; i < planes.Length; ++i)
            {
                var normal = planes[i].normal;
                planesOfSea[4 * i] = normal.x;
                planesOfSea[4 * i + 1] = normal.y;
                planesOfSea[4 * i + 2] = -normal.z;
                planesOfSea[4 * i + 3] = planes[i].distance + normal.y * level;
            }
            Quadtree.Select(viewer.x, viewer.y - level, -viewer.z, planesOfSea, frame.Bounds);
            Material.SetVector(gridId, Vector(Quadtree.CornerX * Quadtree.StepM - viewer.x, Quadtree.CornerZ * Quadtree.StepM + viewer.z, Quadtree.StepM, Quadtree.Vertices));
            Material.SetVector(fadeId, Vector(0, 0, Quadtree.FadeEndM, 1 / (Quadtree.FadeEndM - Quadtree.FadeStartM)));
            Material.SetVector(meshId, Vector(1 / (LodScale * Quadtree.Vertices), Quadtree.StepM, 0, Quadtree.DeepestLevel));
        }

        /// <summary>Draws the patches, those of equal stitching together.</summary>
        private void Draw(in Frame frame, Vector3 viewer)
        {
            var bounds = frame.Bounds;
            var high = 2 * Math.Max(-bounds.HeightMinM, bounds.HeightMaxM);
            var parameters = new RenderParams(Material)
            {
                camera = Camera,
                layer = gameObject.layer,
                shadowCastingMode = ShadowCastingMode.Off,
                worldBounds = new UnityEngine.Bounds(new Vector3(viewer.x, (float)frame.Water.SeaLevelM, viewer.z), new Vector3(2 * SizeM, high, 2 * SizeM)),
            };
            var draws = 0;
            for (var stitches = 0; stitches < 16; ++stitches)
            {
                var count = 0;
                for (var i = 0; i < Quadtree.Count; ++i)
                {
                    ref readonly var patch = ref Quadtree[i];
                    if ((int)patch.Stitches != stitches) continue;
                    patches[2 * count] = new Vector4(patch.CornerX, patch.CornerZ, 2 * patch.Level + patch.Diagonals, patch.InnerWeight);
                    patches[2 * count + 1] = new Vector4(patch.EastWeight, patch.NorthWeight, patch.WestWeight, patch.SouthWeight);
                    if (++count < PatchesOfDraw) continue;
                    Draw(ref parameters, stitches, count, draws++);
                    count = 0;
                }
                if (count > 0) Draw(ref parameters, stitches, count, draws++);
            }
        }

        private void Draw(ref RenderParams parameters, int stitches, int count, int draw)
        {
            if (draw == properties.Count) properties.Add(new MaterialPropertyBlock());
            properties[draw].SetVectorArray(patchesId, patches);
            parameters.matProps = properties[draw];
            Graphics.RenderMeshPrimitives(parameters, mesh, stitches, count);
        }

        /// <summary>
        /// A mesh of vertices (i, 0, j), with a submesh for each stitching. Triangles that are counter-clockwise in
        /// the sea's axes are clockwise in Unity's, as Unity expects.
        /// </summary>
        private static Mesh PatchMesh(int vertices)
        {
            var positions = new Vector3[(vertices + 1) * (vertices + 1)];
            for (var i = 0; i < positions.Length; ++i) positions[i] = new Vector3(i % (vertices + 1), 0, i / (vertices + 1));
            var mesh = new Mesh { vertices = positions, subMeshCount = 16 };
            for (var stitches = 0; stitches < 16; ++stitches)
                mesh.SetIndices(Quadtree.Triangles(vertices, (PatchSides)stitches), MeshTopology.Triangles, stitches);
            return mesh;
        }

        private static Texture2D TextureOf(byte[][] levels)
        {
            // Linear: the values are no colours.
            var texture = new Texture2D(DetailTextures.Side, DetailTextures.Side, TextureFormat.RGBA32, true, true)
            {
                wrapMode = TextureWrapMode.Repeat,
                filterMode = FilterMode.Trilinear,
            };
            for (var level = 0; level < levels.Length; ++level) texture.SetPixelData(levels[level], level);
            texture.Apply(false);
            return texture;
        }

        private static double Fraction(double value) => value - Math.Floor(value);
        private static Vector4 WithW(Vector3 vector, float w) => new Vector4(vector.x, vector.y, vector.z, w);
        private static Vector4 Vector(double x, double y, double z, double w) => new Vector4((float)x, (float)y, (float)z, (float)w);
    }
}
