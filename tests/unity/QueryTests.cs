using System;
using Pelagic;

public static unsafe class QueryTests
{
    /// <summary>The positions of the driver.</summary>
    public static void Points(double[] x, double[] z)
    {
        for (var i = 0; i < x.Length; ++i)
        {
            x[i] = i * 37.77 % 1200 - 600;
            z[i] = i * 12.345 % 1000 - 500;
        }
    }

    private static uint Bits(float value) => *(uint*)&value;

    [Test]
    public static void SamplesAreThoseOfTheCInterface()
    {
        double[] x = new double[500], z = new double[500];
        Points(x, z);
        float[] height = new float[500], normalY = new float[500], velocityX = new float[500], foam = new float[500];
        var converged = new byte[500];
        using (var ocean = new Ocean(Sea.Preset("storm"), new OceanOptions { Queries = true, Velocities = true, Foam = true }))
        {
            GoldenTests.FrameAt(ocean, 12.34);
            foreach (var interpolation in new[] { Interpolation.Linear, Interpolation.Cubic })
            {
                ocean.Query(x, z, new Samples { HeightM = height, NormalY = normalY, VelocityXMps = velocityX, Foam = foam, Converged = converged }, interpolation);
                for (var i = 0; i < 500; ++i)
                {
                    var expected = Expected.Text($"query {(int)interpolation} {i}");
                    Check.Equal($"{Bits(height[i]):x8}{Bits(normalY[i]):x8}{Bits(velocityX[i]):x8}{Bits(foam[i]):x8}{converged[i]}", expected, $"sample {i}");
                }
            }
            ocean.Query(x, z, new Samples { HeightM = height });
            for (var i = 0; i < 500; i += 50) Check.Equal(ocean.HeightAt(x[i], z[i]), height[i], "HeightAt()");
        }
    }

    [Test]
    public static void ARayFromAboveHitsTheSurfaceAtItsHeight()
    {
        using (var ocean = new Ocean(Sea.Preset("storm"), new OceanOptions { Queries = true }))
        {
            GoldenTests.FrameAt(ocean, 1);
            var hit = ocean.FirstHit(new Ray { OriginXM = 3, OriginYM = 50, OriginZM = -4, DirectionY = -1, ReachM = 100 });
            Check.Equal(hit.IsHit, 1, "IsHit");
            // The query and the ray have tolerances of 1 mm sideways each; slopes are below 1.
            Check.True(Math.Abs(hit.PositionYM - ocean.HeightAt(3, -4)) < 0.002, "the height");
            Check.True(Math.Abs(hit.DistanceM - (50 - hit.PositionYM)) < 1e-6 && hit.PositionXM == 3, "the distance");
        }
    }

    [Test]
    public static void WrongLengthsAreRejected()
    {
        using (var ocean = new Ocean(Sea.Default, new OceanOptions { Queries = true }))
        {
            GoldenTests.FrameAt(ocean, 0);
            Check.Throws<ArgumentException>(() => ocean.Query(new double[3], new double[2], default), "z is shorter");
            Check.Throws<ArgumentException>(() => ocean.Query(new double[3], new double[3], new Samples { HeightM = new float[2] }), "too few heights");
            ocean.Query(default, default, default);
        }
    }
}
