using System;
using Pelagic;

public static class QueryTests
{
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
