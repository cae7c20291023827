"""What a build has found, told to people: the content that the page and the article share."""
