using System;

namespace Pelagic
{
    /// <summary>
    /// Periodic textures of detail below the texels of cascades: RGBA, 256 x 256, with all levels. Texels of a level
    /// are in tight rows. Each call computes for some tenths of a second.
    /// </summary>
    public static class DetailTextures
    {
        public const int Side = 256, Levels = 9;
        /// <summary>Least period of ripples, metres: the shortest wave is then 17 mm, the slowest.</summary>
        public const double RipplesM = 0.408;

        /// <summary>
        /// Ripples: slopes along x and z as (byte / 255) 2 - 1, with standard deviation 1/4 at level 0; 0; the
        /// fraction of the slopes' mean square that the level resolves. Most run along +x.
        /// </summary>
        public static byte[][] Ripples()
        {
            var random = new Random(7);
            float[] x = new float[Side * Side], z = new float[Side * Side];
            for (var wave = 0; wave < 96; ++wave)
            {
                // Wave numbers are uniform in their logarithm. The spectrum of slopes is flat, and falls below 6 cm.
                var k = 3 * Math.Pow(24 / 3.0, (wave + random.NextDouble()) / 96);
                var angle = (random.NextDouble() + random.NextDouble() + random.NextDouble() - 1.5) * 1.6;
                double kx = Math.Round(k * Math.Cos(angle)), kz = Math.Round(k * Math.Sin(angle)), phase = random.NextDouble();
                double length = Math.Max(1, Math.Sqrt(kx * kx + kz * kz)), slope = Math.Min(1, 8.5 / length) / length;
                for (var j = 0; j < Side; ++j)
                    for (var i = 0; i < Side; ++i)
                    {
                        var cosine = Math.Cos(2 * Math.PI * ((kx * i + kz * j) / Side + phase));
                        x[j * Side + i] += (float)(slope * kx * cosine);
                        z[j * Side + i] += (float)(slope * kz * cosine);
                    }
            }
            var scale = (float)(0.25 / Math.Sqrt(MeanSquare(x, z) / 2));
            for (var i = 0; i < x.Length; ++i)
            {
                x[i] = Clamp(x[i] * scale, -1, 1);
                z[i] = Clamp(z[i] * scale, -1, 1);
            }
            var all = MeanSquare(x, z);
            var levels = new byte[Levels][];
            for (var level = 0; level < Levels; ++level)
            {
                var resolved = ByteOf((float)(MeanSquare(x, z) / all));
                levels[level] = new byte[4 * x.Length];
                for (var i = 0; i < x.Length; ++i)
                {
                    levels[level][4 * i] = ByteOf(x[i] * 0.5f + 0.5f);
                    levels[level][4 * i + 1] = ByteOf(z[i] * 0.5f + 0.5f);
                    levels[level][4 * i + 3] = resolved;
                }
                x = Halved(x, Side >> level);
                z = Halved(z, Side >> level);
            }
            return levels;
        }

        /// <summary>
        /// Structure of foam, a torn sheet with holes of many sizes: the fraction of texels that are lower; slopes as
        /// (byte - 128) / 127; the standard normal score of the fraction as 3.2 (byte - 128) / 127. On each level the
        /// fraction a exceeds 1 - a.
        /// </summary>
        public static byte[][] Lace()
        {
            var random = new Random(11);
            CellNoise[] holes = { new CellNoise(5, 0.6, random), new CellNoise(11, 0.55, random),
                                  new CellNoise(23, 0.5, random), new CellNoise(47, 0.45, random),
                                  new CellNoise(89, 0.4, random) };
            int[] lumpSizes = { 3, 7, 15, 31, 67 }, bendSizes = { 4, 13, 37 };
            var lumps = Array.ConvertAll(lumpSizes, size => new GradientNoise(size, random));
            GradientNoise[] bendX = Array.ConvertAll(bendSizes, size => new GradientNoise(size, random)),
                            bendZ = Array.ConvertAll(bendSizes, size => new GradientNoise(size, random));
            var sheet = new float[Side * Side];
            for (var j = 0; j < Side; ++j)
                for (var i = 0; i < Side; ++i)
                {
                    double x = (i + 0.5) / Side, z = (j + 0.5) / Side, bentX = x, bentZ = z, height = 0, weight = 1;
                    for (var bend = 0; bend < bendSizes.Length; ++bend)
                    {
                        bentX += 0.2 / bendSizes[bend] * bendX[bend].At(x, z);
                        bentZ += 0.2 / bendSizes[bend] * bendZ[bend].At(x, z);
                    }
                    for (var size = 0; size < holes.Length; ++size)
                    {
                        double hole = holes[size].Distance(bentX, bentZ), lump = lumps[size].At(bentX, bentZ);
                        height += weight * (0.9 * hole + 0.55 * lump);
                        weight *= 0.88;
                    }
                    sheet[j * Side + i] = (float)height;
                }
            float[] slopeX = new float[sheet.Length], slopeZ = new float[sheet.Length];
            for (var j = 0; j < Side; ++j)
                for (var i = 0; i < Side; ++i)
                {
                    slopeX[j * Side + i] = sheet[j * Side + (i + 1) % Side] - sheet[j * Side + (i + Side - 1) % Side];
                    slopeZ[j * Side + i] = sheet[(j + 1) % Side * Side + i] - sheet[(j + Side - 1) % Side * Side + i];
                }
            var scale = (float)(0.3 / Math.Sqrt(MeanSquare(slopeX, slopeZ) / 2));
            for (var i = 0; i < slopeX.Length; ++i)
            {
                slopeX[i] = Clamp(slopeX[i] * scale, -1, 1);
                slopeZ[i] = Clamp(slopeZ[i] * scale, -1, 1);
            }
            sheet = Ranks(sheet);
            var levels = new byte[Levels][];
            for (var level = 0; level < Levels; ++level)
            {
                // Averages concentrate around 0.5, where a threshold would cover all or nothing.
                var ranks = level == 0 ? sheet : Ranks(sheet);
                levels[level] = new byte[4 * ranks.Length];
                for (var i = 0; i < ranks.Length; ++i)
                {
                    levels[level][4 * i] = ByteOf(ranks[i]);
                    levels[level][4 * i + 1] = (byte)Math.Round(128 + slopeX[i] * 127);
                    levels[level][4 * i + 2] = (byte)Math.Round(128 + slopeZ[i] * 127);
                    levels[level][4 * i + 3] = (byte)Math.Round(128 + Clamp(Score(ranks[i]) / 3.2f, -1, 1) * 127);
                }
                sheet = Halved(sheet, Side >> level);
                slopeX = Halved(slopeX, Side >> level);
                slopeZ = Halved(slopeZ, Side >> level);
            }
            return levels;
        }

        private static float Clamp(float value, float low, float high) => Math.Min(Math.Max(value, low), high);
        private static byte ByteOf(float value) => (byte)(Clamp(value, 0, 1) * 255 + 0.5f);
        private static double Fraction(double value) => value - Math.Floor(value);

        /// <summary>Value that a standard normal variable exceeds with probability 1 - rank (Winitzki 2008).</summary>
        private static float Score(float rank)
        {
            double log = Math.Log(4.0 * rank * (1 - rank)), t = 2 / (Math.PI * 0.147) + 0.5 * log;
            return (float)(Math.Sign(rank - 0.5) * Math.Sqrt(2 * (Math.Sqrt(t * t - log / 0.147) - t)));
        }

        private static double MeanSquare(float[] x, float[] z)
        {
            double sum = 0;
            for (var i = 0; i < x.Length; ++i) sum += x[i] * x[i] + z[i] * z[i];
            return sum / x.Length;
        }

        private static float[] Halved(float[] texels, int side)
        {
            var half = side / 2;
            var coarser = new float[half * half];
            for (var j = 0; j < half; ++j)
                for (var i = 0; i < half; ++i)
                {
                    var at = 2 * j * side + 2 * i;
                    coarser[j * half + i] = 0.25f * (texels[at] + texels[at + 1] + texels[at + side] + texels[at + side + 1]);
                }
            return coarser;
        }

        private static float[] Ranks(float[] values)
        {
            var keys = (float[])values.Clone();
            var order = new int[values.Length];
            for (var i = 0; i < order.Length; ++i) order[i] = i;
            Array.Sort(keys, order);
            var ranks = new float[values.Length];
            for (var i = 0; i < order.Length; ++i) ranks[order[i]] = (i + 0.5f) / order.Length;
            return ranks;
        }

        /// <summary>Bubbles, one in each of cells^2 squares of the unit square.</summary>
        private sealed class CellNoise
        {
            private readonly int cells;
            private readonly double[] x, z, radius;

            internal CellNoise(int cells, double maxRadius, Random random)
            {
                this.cells = cells;
                x = new double[cells * cells];
                z = new double[cells * cells];
                radius = new double[cells * cells];
                for (var i = 0; i < x.Length; ++i)
                {
                    x[i] = random.NextDouble();
                    z[i] = random.NextDouble();
                    var size = random.NextDouble();
                    radius[i] = maxRadius * size * size;
                }
            }

            /// <summary>Distance to the nearest bubble, in squares; negative within it.</summary>
            internal double Distance(double atX, double atZ)
            {
                double px = Fraction(atX) * cells, pz = Fraction(atZ) * cells, nearest = 9;
                int cellX = (int)px, cellZ = (int)pz;
                for (var dz = -1; dz <= 1; ++dz)
                    for (var dx = -1; dx <= 1; ++dx)
                    {
                        var at = (cellZ + dz + cells) % cells * cells + (cellX + dx + cells) % cells;
                        double awayX = cellX + dx + x[at] - px, awayZ = cellZ + dz + z[at] - pz;
                        nearest = Math.Min(nearest, Math.Sqrt(awayX * awayX + awayZ * awayZ) - radius[at]);
                    }
                return nearest;
            }
        }

        /// <summary>Gradient noise in [-1, 1] with cells^2 cells in the unit square (Perlin 2002).</summary>
        private sealed class GradientNoise
        {
            private readonly int cells;
            private readonly double movedX, movedZ;
            private readonly double[] cosine, sine;

            internal GradientNoise(int cells, Random random)
            {
                this.cells = cells;
                movedX = random.NextDouble();
                movedZ = random.NextDouble();
                cosine = new double[cells * cells];
                sine = new double[cells * cells];
                for (var i = 0; i < cosine.Length; ++i)
                {
                    var angle = 2 * Math.PI * random.NextDouble();
                    cosine[i] = Math.Cos(angle);
                    sine[i] = Math.Sin(angle);
                }
            }

            internal double At(double atX, double atZ)
            {
                double px = Fraction(atX + movedX) * cells, pz = Fraction(atZ + movedZ) * cells;
                int x = (int)px, z = (int)pz;
                px -= x;
                pz -= z;
                double u = px * px * px * (px * (px * 6 - 15) + 10), v = pz * pz * pz * (pz * (pz * 6 - 15) + 10);
                double near = (1 - u) * Corner(x, z, px, pz) + u * Corner(x + 1, z, px - 1, pz);
                double far = (1 - u) * Corner(x, z + 1, px, pz - 1) + u * Corner(x + 1, z + 1, px - 1, pz - 1);
                return 1.414 * ((1 - v) * near + v * far);
            }

            private double Corner(int x, int z, double awayX, double awayZ)
            {
                var at = z % cells * cells + x % cells;
                return cosine[at] * awayX + sine[at] * awayZ;
            }
        }
    }
}
