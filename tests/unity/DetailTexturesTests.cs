using System;
using System.Linq;
using Pelagic;

public static class DetailTexturesTests
{
    private static double Slope(byte value) => value / 255.0 * 2 - 1;

    [Test]
    public static void RipplesHaveTheSlopesThatTheirLevelsState()
    {
        var levels = DetailTextures.Ripples();
        Check.Equal(levels.Length, 9, "levels");
        var all = 1 / 8.0;  // two axes, standard deviation 1/4
        for (var level = 0; level < 5; ++level)
        {
            var texels = levels[level];
            Check.Equal(texels.Length, 4 * (256 >> level) * (256 >> level), "bytes");
            double square = 0;
            for (var i = 0; i < texels.Length; i += 4) square += Slope(texels[i]) * Slope(texels[i]) + Slope(texels[i + 1]) * Slope(texels[i + 1]);
            square /= texels.Length / 4;
            // Rounding to a byte changes slopes by up to 1/255, and clamping removes less than 0.2 % of the square.
            Check.True(Math.Abs(square / all - texels[3] / 255.0) < 0.01, $"mean square of level {level}");
        }
        Check.True(levels[8][3] < 3, "the last level resolves nothing");
    }

    [Test]
    public static void AThresholdOfLaceCoversItsFractionOnEachLevel()
    {
        var levels = DetailTextures.Lace();
        for (var level = 0; level < 6; ++level)
        {
            var ranks = levels[level].Where((value, i) => i % 4 == 0).ToArray();
            for (var threshold = 0.1; threshold < 1; threshold += 0.1)
                // Ranks are distinct; a byte holds them with steps of 1/255.
                Check.True(Math.Abs(ranks.Count(rank => rank / 255.0 > threshold) / (double)ranks.Length - (1 - threshold)) < 0.005 + 1.0 / ranks.Length,
                           $"fraction above {threshold} of level {level}");
        }
        // Structure, not noise: neighbours have similar ranks. Independent ranks differ by 1/3 on average; a decade
        // of sizes, of equal share each, ends at a few texels, so that ranks differ by more than those of cells did.
        var first = levels[0].Where((value, i) => i % 4 == 0).ToArray();
        var apart = Enumerable.Range(0, first.Length - 1).Average(i => Math.Abs(first[i] - first[i + 1]) / 255.0);
        Check.True(apart < 0.1, $"neighbours differ by {apart}");
    }
}
