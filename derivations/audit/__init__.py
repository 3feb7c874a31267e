"""Each of the documents' numbered equations against first principles."""
