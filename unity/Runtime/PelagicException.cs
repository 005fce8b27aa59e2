using System;
using System.Text;

namespace Pelagic
{
    /// <summary>
    /// A call that failed. If a callback of the application threw, its exception is the inner one.
    /// </summary>
    public sealed class PelagicException : Exception
    {
        public Status Status { get; }

        internal PelagicException(Status status, string message, Exception inner = null) : base(message, inner)
        {
            Status = status;
        }
    }

    internal static unsafe class Errors
    {
        /// <summary>Throws unless the call that returned the status succeeded.</summary>
        internal static void Check(Status status)
        {
            if (status != Status.Ok) throw Of(status);
        }

        /// <summary>The exception of the last call on this thread.</summary>
        internal static PelagicException Of(Status status)
        {
            return new PelagicException(status, TextOf(Native.pelagic_last_error()));
        }

        internal static string TextOf(byte* text)
        {
            if (text == null) return "";
            var length = 0;
            while (text[length] != 0) ++length;
            return Encoding.UTF8.GetString(text, length);
        }

        /// <summary>UTF-8 with a final 0, or null for null.</summary>
        internal static byte[] BytesOf(string text)
        {
            return text == null ? null : Encoding.UTF8.GetBytes(text + "\0");
        }
    }
}
